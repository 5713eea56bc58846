"""The tasks of an execution: takes them from their stream, has them assigned, and judges when they are done.

What a robot has done is judged by its true pose, while the current plan leads it there: it rests at the goal of its
errand for the service time. Planners that support goal sequences plan over several errands, up to one with a service
time or a wanted yaw, and the robot visits those before the last one without a stop.
"""

import math
import time
from collections.abc import Mapping, Sequence, Set
from itertools import takewhile
from typing import Protocol

import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.checking.assignment import check_queues
from mrpbench_core.checking.tasks import task_fault
from mrpbench_core.engine.contract_checks import check_ended, check_released
from mrpbench_core.engine.execution.destinations import Destinations, Errand, Errands, Places
from mrpbench_core.engine.execution.planned_errands import PlannedErrands
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.queue_problems import QueueProblems
from mrpbench_core.engine.execution.reactions import reaches
from mrpbench_core.engine.execution.task_board import Job, TaskBoard, TaskEvent
from mrpbench_core.model.common.arrays import Bool, Int
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.scenario import Task

ELSEWHERE = -1
"""Stands for the task of a robot that goes to a place instead of taking tasks."""


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
        sequences: the planner takes several goals of a robot.
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
        sequences: bool = False,
    ) -> None:
        self._stream, self._assigner, self._costs, self._places = stream, assigner, costs, places
        self._queue_problems = QueueProblems(assigner, costs)
        self._roadmap = problem.roadmap
        starts = zip(costs.profile.tolist(), problem.start.tolist(), strict=True)
        self._components = {(profile, costs.labels[profile][start]) for profile, start in starts}
        """Motion profiles, each with the label of the vertices that some of its robots can reach."""
        self._recorder, self._interval = recorder, interval
        self._robots = range(len(problem))
        self._board = TaskBoard(len(problem))
        self._next = 0
        self._head: Int = problem.start.astype(np.int64)
        self._aborted: Bool = np.zeros(len(problem), bool)
        self._elsewhere: Mapping[int, tuple[float, float, int] | None] = {}
        """See `TaskStream.elsewhere`."""
        self._unassigned = True
        """Tasks or robots have changed since the last assignment."""
        self._sequences = sequences
        self._planned = PlannedErrands(len(problem))
        self._ways: list[list[Errand]] = [[] for _ in self._robots]
        """The errands ahead of each robot."""
        self._names: list[Errands] = [()] * len(problem)
        """The names of the same."""
        self._missed: set[int] = set()
        """Robots that came to rest without having visited all goals of their paths; they stop at the next one."""
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
        return check_ended(self._stream.ended) and not self._board.jobs

    @property
    def unfinished(self) -> Set[int]:
        """The indices of the tasks that are released and not finished."""
        return self._board.jobs.keys()

    @property
    def unserved(self) -> bool:
        """True if no task was done and the planner finds no plan."""
        return self._failures > 0 and self._board.finished == 0

    def begin(self, now: float, state: State, head: Int, aborted: Bool, given_up: Bool) -> None:
        """Take in the tasks released until `now`, and have them assigned.

        Args:
            now: simulated seconds.
            state: the true one.
            head: i8[n] vertices at which robots come to rest if nothing more is released.
            aborted: bool[n]: the robot gave up, or is out of order for now; its tasks that are not begun go to others.
            given_up: bool[n]: the robot will not go on with the task that it has begun.
        """
        for robot in np.flatnonzero(given_up).tolist():
            self._board.give_up(now, robot)
        tasks = check_released(self._stream.released(now, self._board.finished))
        for task in tasks:
            self._take(now, task)
        places = self._stream.elsewhere(now, state)
        if places != self._elsewhere:
            self._board.changed |= {robot for robot, _ in places.items() ^ self._elsewhere.items()}
            self._elsewhere = {**places}
        aborted = aborted | np.isin(self._robots, [*places])
        if (aborted != self._aborted).any():
            self._aborted, self._unassigned = aborted, True
        self._head = head
        if self._unassigned:
            self._assign(now)
        self._record(tasks)

    def _take(self, now: float, task: Task) -> None:
        """Take one task in, unless no robot can do it."""
        if task.index != self._next or not task.release <= now:
            raise BrokenContractError(
                f"the task source gave task {task.index}, released at {task.release:g} s, as number {self._next} at "
                f"{now:g} s",
                "tasks",
            )
        self._next += 1
        if (fault := task_fault(task)) is not None:
            raise BrokenContractError(f"the task source gave task {task.index}, which {fault}", "tasks")
        located = self._roadmap.locate(task.goals[:, :2], task.levels).tolist()
        places = zip(located, task.goals[:, 2].tolist(), strict=True)
        yaws = tuple({it: yaw for it, yaw in goal if it >= 0} for goal in task.by_errand([*places]))
        able = any(
            all(any(self._costs.labels[profile][vertex] == label for vertex in goal) for goal in yaws)
            for profile, label in self._components
        )
        if able:
            self._board.release(now, task, yaws)
            self._unassigned = True
        else:
            self._board.refuse(now, task)

    def judge(self, now: float, arrived: Bool, visited: Int) -> None:
        """Judge which errands are done.

        Args:
            now: simulated seconds.
            arrived: bool[n]: the robot truly rests at the end of its path.
            visited: i8[n] goals before the last one that the robot has truly visited, of the current plan.
        """
        for robot in np.flatnonzero(visited > self._planned.gone).tolist():
            while self._planned.gone[robot] < visited[robot]:
                errand, job = self._planned.visit(robot), self._board.current(robot)
                if job is not None and (job.task.index, job.errand) == errand:
                    self._rest(now, robot, job)
        for robot in sorted(self._board.resting.union(np.flatnonzero(arrived).tolist())):
            job = self._board.current(robot)
            if job is None:
                continue
            if arrived[robot] and self._planned.ahead[robot] == ((job.task.index, job.errand),):
                self._rest(now, robot, job)
                if robot in self._missed:
                    self._missed.remove(robot)
                    self._board.changed.add(robot)
            else:
                self._board.leave(robot)
                if arrived[robot] and len(self._planned.ahead[robot]) > 1:
                    self._missed.add(robot)
                    self._board.changed.add(robot)
                    self._planned.drop(robot)
        self._record()

    def _rest(self, now: float, robot: int, job: Job) -> None:
        """Note that a robot rests at its errand, or visits one without a service time."""
        begun = job.begun
        if self._board.rest(now, robot):
            self._unassigned |= self._board.current(robot) is not job
        self._unassigned |= not begun

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
        problem = self._queue_problems.of(now, self._board, open_tasks, self._head, self._aborted)
        began = time.perf_counter()
        try:
            queues = self._assigner.assign_queues(problem)
        except AssignmentError:
            return
        finally:
            self.assignment_s.append(time.perf_counter() - began)
        if fault := check_queues(problem, queues):
            raise BrokenContractError(f"the assigner {fault}", "assigner")
        self._board.assign(now, tuple(tuple(open_tasks[int(task)] for task in queue) for queue in queues))

    def reason(self, now: float) -> str | None:
        """Return why a new plan is needed now, or None: some robot's errand is not the one of its path."""
        if now < self._planned_at + self._interval - 1e-9:
            return None
        self._look_ahead()
        wanted = self._names
        other = self._planned.others(wanted)
        if not other and not self._held_back:
            return None
        new = [robot for robot in other if wanted[robot]]
        if new:
            return f"robot {new[0]} has another errand"
        makes_room = any(ours and not path for ours, path in zip(wanted, self._planned.ahead, strict=True))
        return "a robot that made room may go on" if makes_room else None

    def destinations(self, now: float, held: Bool, restricted: Problem) -> Destinations:
        """Return the goals of the next plan.

        Robots that are `held` bool[n] stay where they come to rest, and so do those that cannot reach their errands in
        the `restricted` problem.

        Robots that rest at their errand come first, then the oldest tasks. After each plan that was not found, half as
        many robots are sent to errands, others each time, until a plan is found.
        """
        self._planned_at = now
        self._look_ahead()
        self._planned.ask(self._names.copy())
        heads = self._head.tolist()
        going = zip(self._ways, heads, held.tolist(), strict=True)
        ways = [self._costs.nearest_first(way, head) for way, head, stays in going if way and not stays]
        if restricted.roadmap is not self._roadmap:
            ways = [[*takewhile(lambda it: it.yaws, (self._within(restricted, it) for it in way))] for way in ways]
        resting: list[Sequence[Errand]] = []
        moving: list[Sequence[Errand]] = []
        for way in filter(None, ways):
            job = self._board.jobs.get(way[0].task)
            if heads[way[0].robot] in way[0].yaws if job is None else not math.isnan(job.since):
                resting.append([way[0].at([*way[0].yaws][:1]), *way[1:]])  # it is there
            else:
                moving.append(way)
        moving.sort(key=lambda way: way[0].task)
        if self._failures and moving:
            first = self._failures % len(moving)
            moving = [way[:1] for way in moving[first:] + moving[:first]][: max(1, len(moving) >> self._failures)]
        return self._places.destinations(resting + moving, self._head, self._failures, held)

    def adopt(self, destinations: Destinations) -> Int:
        """Adopt a plan to these goals; return how many of each robot i8[n] are done since it was asked for."""
        self._planned.adopt(destinations.errands, self._is_done)
        self._held_back, self._failures = self._failures > 0, 0
        return self._planned.gone

    def failed(self) -> None:
        """Note that no plan to the last goals takes effect."""
        self._failures += 1

    def _look_ahead(self) -> None:
        """Take note of the errands ahead of robots for which they have changed."""
        for robot in self._board.changed:
            ahead = self._ways[robot] = self._ahead(robot)
            self._names[robot] = tuple((errand.task, errand.number) for errand in ahead)
        self._board.changed.clear()

    def _ahead(self, robot: int) -> list[Errand]:
        """The errands to which a plan leads a robot: the next one and, if it need not rest there, those after it."""
        ahead: list[Errand] = []
        if (place := self._elsewhere.get(robot)) is not None and not self._board.queues[robot]:
            vertex = int(self._roadmap.locate(np.array([place[:2]]), np.array([place[2]], np.int16))[0])
            return [Errand(robot, ELSEWHERE, vertex, {vertex: math.nan})]
        for job in self._board.queue(robot):
            for number in range(job.errand, len(job.places)):
                ahead.append(Errand(robot, job.task.index, number, job.yaws[number]))
                if job.rests[number] or not self._sequences or robot in self._missed:
                    return ahead
        return ahead

    def _within(self, restricted: Problem, errand: Errand) -> Errand:
        """Leave out places that the robot cannot reach in a problem."""
        head = int(self._head[errand.robot])
        return errand.at(it for it in errand.yaws if reaches(restricted, errand.robot, head, (it,)))

    def _is_done(self, errand: tuple[int, int]) -> bool:
        task, number = errand
        job = self._board.jobs.get(task)
        return task != ELSEWHERE and (job is None or job.errand > number)
