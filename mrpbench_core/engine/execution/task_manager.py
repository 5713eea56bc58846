"""The tasks of an execution: takes them from their stream, has them assigned, and judges when they are done.

What a robot has done is judged by its true pose: it rests at the goal of its errand for the service time, while the
plan in force leads it there.
"""

import math
import time
from collections.abc import Sequence, Set
from typing import Protocol

import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.checking.assignment import check_queues
from mrpbench_core.engine.execution.destinations import Destinations, Errand, Places
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.reactions import reaches
from mrpbench_core.engine.execution.task_board import Job, TaskBoard, TaskEvent
from mrpbench_core.engine.own import Handed, name_of, own
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.assignment import QueueProblem
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.scenario import Task

Errands = tuple[tuple[int, int] | None, ...]
"""For each robot a task and the number of an errand of it."""


class TaskRecorder(Protocol):
    """Records tasks; see the channels `errand_...` and `task_...` of a recording."""

    def tasks(self, tasks: Sequence[Task], events: Sequence[TaskEvent]) -> None:
        """Record tasks that were released, and what happened."""


class TaskManager:
    """Holds the tasks of one execution.

    Args:
        stream: gives the tasks.
        assigner: decides which robot does which.
        costs: of ways, for the assigner.
        places: where robots may rest.
        problem: the first problem.
        recorder: receives what happens.
        interval: least simulated seconds between two plans because of tasks.
    """

    def __init__(
        self,
        stream: TaskStream,
        assigner: Assigner,
        costs: QueueCosts,
        places: Places,
        problem: Problem,
        recorder: TaskRecorder,
        interval: float,
    ) -> None:
        self._stream, self._assigner, self._costs, self._places = stream, assigner, costs, places
        self._roadmap, self._start = problem.roadmap, problem.start
        self._recorder, self._interval = recorder, interval
        self._robots = range(len(problem))
        self._board = TaskBoard(len(problem))
        self._next = 0
        self._head: Int = problem.start.astype(np.int64)
        self._aborted: Bool = np.zeros(len(problem), bool)
        self._unassigned = True
        """Tasks or robots have changed since the last assignment."""
        self._in_force: Errands = (None,) * len(problem)
        """Where the paths of robots lead."""
        self._asked: Errands = self._in_force
        self._planned: Errands = self._in_force
        """What robots had to do when a plan was asked for last, and when that in force was."""
        self._held_back = False
        """Some robots were not sent to their errands, so that a plan is found."""
        self._failures = 0
        """Plans in a row that were not found."""
        self._planned_at = -math.inf
        self.assignment_s: list[float] = []
        """Wall seconds of each call of the assigner."""

    @property
    def ended(self) -> bool:
        """True if all tasks are done and none will come."""
        return self._stream.ended and not self._board.jobs

    @property
    def unfinished(self) -> Set[int]:
        """The indices of the tasks that are released and not finished."""
        return self._board.jobs.keys()

    @property
    def unserved(self) -> bool:
        """True if no task was done and the planner finds no plan."""
        return self._failures > 0 and self._board.finished == 0

    def begin(self, now: float, head: Int, aborted: Bool, given_up: Bool) -> None:
        """Take in the tasks released until `now`, and have them assigned.

        Args:
            now: simulated seconds.
            head: i8[n] vertices at which robots come to rest if nothing more is released.
            aborted: bool[n]: the robot gave up, or is out of order for now; its tasks that are not begun go to others.
            given_up: bool[n]: the robot will not go on with the task that it has begun.
        """
        for robot in np.flatnonzero(given_up).tolist():
            self._board.give_up(now, robot)
        released = list(self._stream.released(now, self._board.finished))
        tasks = [own(task) for task in released]
        for task in tasks:
            self._take(now, task)
        if (aborted != self._aborted).any():
            self._aborted, self._unassigned = aborted.copy(), True
        self._head = head
        if self._unassigned:
            self._assign(now)
        self._record(tasks)

    def _take(self, now: float, task: Task) -> None:
        """Take one task in, unless no robot can do it."""
        if task.index != self._next or not task.release <= now:
            raise BrokenContractError(
                f"the task source gave task {task.index}, released at {task.release:g} s, as number {self._next} at "
                f"{now:g} s"
            )
        self._next += 1
        if not len(task.goals) == len(task.levels) == len(task.service) > 0:
            raise BrokenContractError(f"the task source gave task {task.index} without a level or service per goal")
        vertices = tuple(int(vertex) for vertex in self._roadmap.locate(task.goals[:, :2], task.levels))
        labels = [self._costs.labels[int(profile)] for profile in self._costs.profile]
        able = min(vertices) >= 0 and any(
            all(label[vertex] == label[start] for vertex in vertices)
            for label, start in zip(labels, self._start.tolist(), strict=True)
        )
        if able:
            self._board.release(now, task, vertices)
            self._unassigned = True
        else:
            self._board.refuse(now, task)

    def judge(self, now: float, arrived: Bool) -> None:
        """Judge which errands are done; `arrived` bool[n]: the robot truly rests at the end of its path."""
        for robot in self._robots:
            job = self._board.current(robot)
            if job is None:
                continue
            if arrived[robot] and self._in_force[robot] == (job.task.index, job.errand):
                begun = job.begun
                if self._board.rest(now, robot):
                    self._unassigned |= self._board.current(robot) is not job
                self._unassigned |= not begun
            else:
                self._board.leave(robot)
        self._record()

    def _record(self, released: Sequence[Task] = ()) -> None:
        if released or self._board.events:
            self._recorder.tasks(released, self._board.events)
            self._board.events = []

    def _assign(self, now: float) -> None:
        """Call the assigner with the tasks that are not begun; if it fails, everything stays as it is."""
        self._unassigned = False
        open_tasks = self._board.unbegun()
        if not open_tasks:
            return
        problem = self._queue_problem(now, open_tasks)
        handed = Handed(problem, "the tasks")
        began = time.perf_counter()
        try:
            queues = self._assigner.assign_queues(handed.given)
        except AssignmentError:
            return
        finally:
            self.assignment_s.append(time.perf_counter() - began)
        handed.check(self._assigner)
        if fault := check_queues(problem, queues):
            raise BrokenContractError(f"{name_of(self._assigner)} {fault}")
        self._board.assign(now, tuple(tuple(open_tasks[int(task)] for task in queue) for queue in queues))

    def _queue_problem(self, now: float, open_tasks: list[int]) -> QueueProblem:
        jobs = [self._board.jobs[index] for index in open_tasks]
        first = np.array([job.vertices[0] for job in jobs], np.int64)
        last = np.array([job.vertices[-1] for job in jobs], np.int64)
        profiles = range(len(self._costs.labels))
        column = {index: number for number, index in enumerate(open_tasks)}
        place, free_in = self._head.copy(), np.zeros(len(self._robots))
        for robot in self._robots:
            if (job := self._board.begun(robot)) is not None:
                profile = int(self._costs.profile[robot])
                ahead = (int(self._head[robot]), *job.vertices[job.errand :])
                free_in[robot] = self._costs.along(profile, ahead) + _service(job, now)
                place[robot] = job.vertices[-1]
        free_in[self._aborted] = np.inf
        length = np.array(
            [[self._costs.along(p, job.vertices) + job.task.service.sum() for job in jobs] for p in profiles]
        )
        approach = np.array(
            [self._costs.seconds(int(p), place[[robot]], first)[0] for robot, p in enumerate(self._costs.profile)]
        )
        length = length[self._costs.profile]
        between: Float = np.empty((0, 0, 0))
        if self._assigner.reads_between:
            between = np.array([self._costs.seconds(p, last, first) for p in profiles])
        return QueueProblem(
            now=now,
            tasks=tuple(job.task for job in jobs),
            queues=tuple(tuple(column[index] for index in queue if index in column) for queue in self._board.queues),
            free_in=free_in,
            approach=np.where(np.isfinite(length), approach, np.inf),
            length=length,
            between=between,
            profile=self._costs.profile.astype(np.int32),
            errands=tuple(job.vertices for job in jobs),
            ahead=tuple(
                () if job is None else job.vertices[job.errand :] for job in map(self._board.begun, self._robots)
            ),
        )

    def reason(self, now: float) -> str | None:
        """Return why a new plan is needed now, or None: some robot's errand is not the one of its path."""
        if now < self._planned_at + self._interval - 1e-9:
            return None
        wanted = self._wanted()
        if wanted == self._planned and not self._held_back:
            return None
        new = [robot for robot in self._robots if wanted[robot] not in (None, self._planned[robot])]
        if new:
            return f"robot {new[0]} has another errand"
        makes_room = any(ours is not None and path is None for ours, path in zip(wanted, self._in_force, strict=True))
        return "a robot that made room may go on" if makes_room else None

    def destinations(self, now: float, held: Bool, restricted: Problem) -> Destinations:
        """Return the goals of the next plan.

        Robots that are `held` bool[n] stay where they come to rest, and so do those that cannot reach their errands in
        the `restricted` problem.

        Robots that rest at their errand come first, then the oldest tasks. After each plan that was not found, half as
        many robots are sent to errands, others each time, until a plan is found.
        """
        self._planned_at, self._asked = now, self._wanted()
        jobs = [(robot, job) for robot, job in enumerate(self._current()) if job is not None and not held[robot]]
        if restricted.roadmap is not self._roadmap:
            jobs = [
                (robot, job)
                for robot, job in jobs
                if reaches(restricted, robot, int(self._head[robot]), (job.vertices[job.errand],))
            ]
        resting = [entry for entry in jobs if not math.isnan(entry[1].since)]
        moving = sorted((entry for entry in jobs if math.isnan(entry[1].since)), key=lambda entry: entry[1].task.index)
        if self._failures and moving:
            first = self._failures % len(moving)
            moving = (moving[first:] + moving[:first])[: max(1, len(moving) >> self._failures)]
        errands = [
            Errand(robot, job.task.index, job.errand, job.vertices[job.errand], float(job.task.goals[job.errand, 2]))
            for robot, job in resting + moving
        ]
        return self._places.destinations(errands, self._head, self._failures, held)

    def adopt(self, destinations: Destinations) -> None:
        """Note that a plan to these goals is in force."""
        self._in_force, self._planned = destinations.errand, self._asked
        self._held_back, self._failures = self._failures > 0, 0

    def failed(self) -> None:
        """Note that no plan to the last goals takes effect."""
        self._failures += 1

    def _wanted(self) -> Errands:
        return tuple(None if job is None else (job.task.index, job.errand) for job in self._current())

    def _current(self) -> list[Job | None]:
        return [self._board.current(robot) for robot in self._robots]


def _service(job: Job, now: float) -> float:
    """Seconds of service that a task still needs."""
    left = float(job.task.service[job.errand :].sum())
    return left if math.isnan(job.since) else max(0.0, left - (now - job.since))
