"""Many tasks in flat arrays."""

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from typing import overload

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int16, Int32, array
from mrpbench_core.model.planning.scenario import Task


@attrs.frozen(kw_only=True)
class Tasks(Sequence[Task]):
    """Tasks in flat arrays, which are copied and compared as a whole; items are made when asked for."""

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

    @overload
    def __getitem__(self, index: int) -> Task: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Task, ...]: ...
    def __getitem__(self, index: int | slice) -> Task | tuple[Task, ...]:
        return self._items[index]

    @cached_property
    def _items(self) -> tuple[Task, ...]:
        places, errands = (
            [slice(*bounds) for bounds in pairwise(first.tolist())] for first in (self.first_place, self.first_errand)
        )
        columns = self.name, self.release.tolist(), self.deadline.tolist(), self.priority, self.number.tolist()
        return tuple(
            Task(
                goals=self.goals[place],
                errand=self.errand[place],
                levels=self.levels[place],
                service=self.service[errand],
                name=name,
                release=release,
                deadline=deadline,
                priority=priority,
                index=index,
            )
            for place, errand, name, release, deadline, priority, index in zip(places, errands, *columns, strict=True)
        )


def joined(tasks: Sequence[Task]) -> Tasks:
    """Hold tasks in flat arrays; `Tasks` are returned as they are."""
    if isinstance(tasks, Tasks):
        return tasks
    return Tasks(
        first_place=np.cumsum([0, *(len(task.goals) for task in tasks)]),
        goals=np.concatenate([np.empty((0, 3)), *(task.goals for task in tasks)]),
        errand=np.concatenate([np.empty(0, np.int32), *(task.errand for task in tasks)]),
        levels=np.concatenate([np.empty(0, np.int16), *(task.levels for task in tasks)]),
        first_errand=np.cumsum([0, *(len(task.service) for task in tasks)]),
        service=np.concatenate([np.empty(0), *(task.service for task in tasks)]),
        name=tuple(task.name for task in tasks),
        release=np.array([task.release for task in tasks]),
        deadline=np.array([task.deadline for task in tasks]),
        priority=tuple(task.priority for task in tasks),
        number=np.array([task.index for task in tasks], np.int64),
    )
