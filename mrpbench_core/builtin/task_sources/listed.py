"""Tasks that are known before the run, in the order of their release."""

from collections.abc import Sequence

from mrpbench_core.api.task_source import TaskStream
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
    def ended(self) -> bool:
        """True if all tasks are released."""
        return self._next >= len(self._tasks)
