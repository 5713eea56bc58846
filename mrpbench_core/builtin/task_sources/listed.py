"""Tasks that are known before the run, in the order of their release."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.planning.scenario import Task


class ListedStream(TaskStream):
    """Gives tasks that are sorted by release, with indices from 0."""

    def __init__(self, tasks: Sequence[Task]) -> None:
        self._tasks, self._next = tasks, 0

    def released(self, now: float, finished: int) -> Sequence[Task]:  # noqa: ARG002
        """Return the tasks that were released until `now`."""
        first = self._next
        while self._next < len(self._tasks) and self._tasks[self._next].release <= now:
            self._next += 1
        return self._tasks[first : self._next]

    @property
    def places(self) -> tuple[Float, Int16]:
        """Where the errands are."""
        goals = np.concatenate([task.goals[:, :2] for task in self._tasks])
        return goals, np.concatenate([task.levels for task in self._tasks])

    @property
    def ended(self) -> bool:
        """True if all tasks are released."""
        return self._next >= len(self._tasks)
