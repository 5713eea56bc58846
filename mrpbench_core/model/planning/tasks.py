"""Many tasks in flat arrays."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int16, Int32, array
from mrpbench_core.model.common.flat_sequence import FlatSequence, firsts, joined, rows
from mrpbench_core.model.planning.scenario import Task


@attrs.frozen(kw_only=True)
class Tasks(FlatSequence[Task]):
    """Many tasks."""

    first_place: Int = array("i8")
    """i8[m+1]: the places of task i are `first_place[i]:first_place[i + 1]`."""
    goals: Float = array("f8", 3)
    """f8[p,3] as in `Task`, like the other columns."""
    errand: Int32 = array("i4")
    levels: Int16 = array("i2")
    first_errand: Int = array("i8")
    """i8[m+1]: the errands of task i are `first_errand[i]:first_errand[i + 1]`."""
    service: Float = array("f8")
    """f8[k] as in `Task`."""
    name: tuple[str, ...]
    release: Float = array("f8")
    """f8[m] as in `Task`, like the other columns."""
    deadline: Float = array("f8")
    priority: tuple[int, ...]
    number: Int = array("i8")
    """i8[m] `Task.index`."""

    def __len__(self) -> int:
        return len(self.name)

    def _item(self, index: int) -> Task:
        places, errands = rows(self.first_place, index), rows(self.first_errand, index)
        return Task(
            goals=self.goals[places],
            errand=self.errand[places],
            levels=self.levels[places],
            service=self.service[errands],
            name=self.name[index],
            release=float(self.release[index]),
            deadline=float(self.deadline[index]),
            priority=self.priority[index],
            index=int(self.number[index]),
        )


def flat_tasks(tasks: Sequence[Task]) -> Tasks:
    """Hold tasks in flat arrays; `Tasks` are returned as they are."""
    if isinstance(tasks, Tasks):
        return tasks
    return Tasks(
        first_place=firsts(len(task.goals) for task in tasks),
        goals=joined((task.goals for task in tasks), "f8", 3),
        errand=joined((task.errand for task in tasks), "i4"),
        levels=joined((task.levels for task in tasks), "i2"),
        first_errand=firsts(len(task.service) for task in tasks),
        service=joined((task.service for task in tasks), "f8"),
        name=tuple(task.name for task in tasks),
        release=np.array([task.release for task in tasks]),
        deadline=np.array([task.deadline for task in tasks]),
        priority=tuple(task.priority for task in tasks),
        number=np.array([task.index for task in tasks], np.int64),
    )
