"""The tasks of an execution that are not finished: who does which, and how far each is."""

import math
from collections.abc import Mapping

import attrs

from mrpbench_core.model.planning.assignment import Queues
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.scenario import Task


@attrs.frozen
class TaskEvent:
    """What happened to a task; see the channels `task_...` of a recording."""

    stamp: float
    task: int
    kind: str
    """One of `TASK_EVENTS`."""
    robot: int = -1
    errand: int = -1


@attrs.define
class Job:
    """A task that is not finished."""

    task: Task
    yaws: tuple[Mapping[int, float], ...]
    """For each errand the radians wanted at each vertex that will do, NaN = any."""
    places: tuple[GoalSet, ...] = attrs.field(init=False)
    """Vertices of each errand, of which any will do."""
    rests: tuple[bool, ...] = attrs.field(init=False)
    """For each errand whether its robot has to rest there, for a service time or a yaw."""
    robot: int = -1
    errand: int = 0
    """The errand that comes next."""
    begun: bool = False
    since: float = math.nan
    """Simulated seconds since which its robot rests at the errand; NaN = it does not."""

    @places.default
    def _places(self) -> tuple[GoalSet, ...]:
        return tuple(map(tuple, self.yaws))

    @rests.default
    def _rests(self) -> tuple[bool, ...]:
        wanted = (not all(map(math.isnan, errand.values())) for errand in self.yaws)
        return tuple(seconds > 0 or yaw for seconds, yaw in zip(self.task.service.tolist(), wanted, strict=True))


class TaskBoard:
    """Keeps each task from its release until it is done; a task has at most one robot, and is done once."""

    def __init__(self, robots: int) -> None:
        self.jobs: dict[int, Job] = {}
        """By index, in the order of their release."""
        self.queues: list[list[int]] = [[] for _ in range(robots)]
        """For each robot the tasks to do, in order; only the first may have begun."""
        self.resting: set[int] = set()
        """All robots that rest at their errands, and perhaps others."""
        self.changed: set[int] = set(range(robots))
        """Robots whose errands ahead have changed, until a reader empties it."""
        self.finished = 0
        """Tasks that are done or given up, or that no robot can do."""
        self.events: list[TaskEvent] = []
        """What happened since the recorder took the events."""

    def release(self, now: float, task: Task, yaws: tuple[Mapping[int, float], ...]) -> None:
        """Take a task in; see `Job.yaws`."""
        self.jobs[task.index] = Job(task, yaws)
        self._note(now, task.index, "released")

    def refuse(self, now: float, task: Task) -> None:
        """Note a task that no robot can do."""
        self.finished += 1
        self._note(now, task.index, "released")
        self._note(now, task.index, "refused")

    def current(self, robot: int) -> Job | None:
        """Return what a robot does now, or goes to do."""
        return self.jobs[self.queues[robot][0]] if self.queues[robot] else None

    def queue(self, robot: int) -> list[Job]:
        """Return what a robot does and will do, in order."""
        return [self.jobs[index] for index in self.queues[robot]]

    def begun(self, robot: int) -> Job | None:
        """Return the task that a robot has begun, if any."""
        job = self.current(robot)
        return job if job is not None and job.begun else None

    def unbegun(self) -> list[int]:
        """Return the tasks that no robot has begun, in the order of their release."""
        return [index for index, job in self.jobs.items() if not job.begun]

    def assign(self, now: float, queues: Queues) -> None:
        """Replace what robots do after the task that they have begun; `queues` holds indices of tasks not begun."""
        before = {index: job.robot for index, job in self.jobs.items() if job.robot >= 0}
        for robot, queue in enumerate(queues):
            job = self.begun(robot)
            new = [*([] if job is None else [job.task.index]), *queue]
            if new != self.queues[robot]:
                self.queues[robot] = new
                self.changed.add(robot)
        for job in self.jobs.values():
            job.robot = -1
        for robot, tasks_of_robot in enumerate(self.queues):
            for index in tasks_of_robot:
                self.jobs[index].robot = robot
        for index, job in self.jobs.items():
            old = before.get(index, -1)
            if job.robot != old:
                if old >= 0:
                    job.since = math.nan
                    self._note(now, index, "withdrawn", old)
                if job.robot >= 0:
                    self._note(now, index, "assigned", job.robot)

    def rest(self, now: float, robot: int) -> bool:
        """Note that a robot rests at its errand; return whether the errand is done, as its service time is over."""
        job = self.current(robot)
        assert job is not None
        index = job.task.index
        if not job.begun:
            job.begun = True
            self._note(now, index, "begun", robot)
        if math.isnan(job.since):
            job.since = now
            self.resting.add(robot)
        if now - job.since < job.task.service[job.errand] - 1e-9:
            return False
        self._note(now, index, "errand", robot, job.errand)
        job.errand += 1
        self.changed.add(robot)
        self._leave(robot, job)
        if job.errand == len(job.places):
            self._note(now, index, "done", robot)
            self.finished += 1
            del self.jobs[index]
            self.queues[robot].pop(0)
        return True

    def give_up(self, now: float, robot: int) -> None:
        """Note that the task that a robot has begun will not be finished."""
        if (job := self.begun(robot)) is not None:
            self._note(now, job.task.index, "given_up", robot)
            self.finished += 1
            del self.jobs[job.task.index]
            self.queues[robot].pop(0)
            self.changed.add(robot)

    def leave(self, robot: int) -> None:
        """Note that a robot does not rest at its errand; a service that was interrupted begins again."""
        if (job := self.current(robot)) is not None:
            self._leave(robot, job)

    def _leave(self, robot: int, job: Job) -> None:
        job.since = math.nan
        self.resting.discard(robot)

    def _note(self, now: float, task: int, kind: str, robot: int = -1, errand: int = -1) -> None:
        self.events.append(TaskEvent(now, task, kind, robot, errand))
