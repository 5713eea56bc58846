"""The books of tasks: every event of a task must follow from those before it."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.engine.execution.task_board import TaskEvent
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.scenario import Task


@attrs.define
class _Entry:
    """A task that is not finished."""

    task: Task
    holder: int = -1
    begun: bool = False
    done: int = 0


class TaskLedger:
    """Books the events of tasks, and lists what contradicts what was booked before.

    A task is released once, in the order of the indices. At most one robot has it, takes it over only while it is not
    begun, and has begun no other. Its errands are done in order, each once, by the robot that has begun it. After the
    last one it is done, and nothing happens to it any more.
    """

    def __init__(self) -> None:
        self.open: dict[int, _Entry] = {}
        """By index."""
        self.faults: list[str] = []
        self.events = self.finished = self._next = 0
        self.position: Float | None = None
        """f8[n,2] metres, where robots truly are, if errands must be done at their places."""
        self._busy: dict[int, int] = {}
        """The task that each robot has begun."""

    def tasks(self, tasks: Sequence[Task], events: Sequence[TaskEvent]) -> None:
        """Book tasks that were released, and what happened; see `TaskRecorder`."""
        released = {task.index: task for task in tasks}
        for event in events:
            self.events += 1
            if event.kind == "released":
                if event.task != self._next or event.task not in released:
                    self.faults.append(f"task {event.task} is released as number {self._next}")
                self._next = event.task + 1
                self.open[event.task] = _Entry(released[event.task])
            elif (entry := self.open.get(event.task)) is None:
                self.faults.append(f"task {event.task} is not open: {event}")
            elif fault := self._book(event, entry):
                self.faults.append(f"{fault}: {event}")

    def _book(self, event: TaskEvent, entry: _Entry) -> str | None:
        """Book an event of an open task; return what is wrong with it."""
        robot, task, errands = event.robot, event.task, entry.task.errands
        if event.kind == "refused":
            del self.open[task]
            self.finished += 1
            return "a robot has it" if entry.holder >= 0 else None
        if event.kind == "assigned":
            fault = "a robot has it" if entry.holder >= 0 else "nobody gets it" if robot < 0 else None
            entry.holder = robot
            return fault
        if robot != entry.holder:
            return f"robot {entry.holder} has it"
        if event.kind == "withdrawn":
            entry.holder = -1
            return "it is begun" if entry.begun else None
        if event.kind == "begun":
            fault = "it is begun" if entry.begun else f"has begun {self._busy[robot]}" if robot in self._busy else None
            entry.begun, self._busy[robot] = True, task
            return fault
        if not entry.begun:
            return "it is not begun"
        if event.kind == "errand":
            fault = None if event.errand == entry.done < errands else f"{entry.done} of {errands} are done"
            entry.done += 1
            return fault or self._away(event, entry.task)
        del self.open[task], self._busy[robot]
        self.finished += 1
        complete = event.kind == "given_up" or entry.done == errands
        return None if complete else f"{entry.done} of {errands} errands are done"

    def _away(self, event: TaskEvent, task: Task) -> str | None:
        """What is wrong with where an errand is done."""
        if self.position is None:
            return None
        gap = np.hypot(*(task.goals[task.errand == event.errand, :2] - self.position[event.robot]).T)
        return None if gap.min() < 1e-6 else f"the robot is {gap.min():g} m away"
