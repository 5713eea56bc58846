"""The problems that assigners get during execution: when and where robots are free for the tasks not begun."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.execution.task_board import Job, TaskBoard
from mrpbench_core.model.common.arrays import Bool, Float, Int, read_only
from mrpbench_core.model.planning.assignment import QueueProblem
from mrpbench_core.model.planning.problem import GoalSet

NOWHERE = -1
"""No label of a vertex."""


class QueueProblems:
    """Builds the problems of one execution.

    Args:
        assigner: gets them.
        costs: of ways.
    """

    def __init__(self, assigner: Assigner, costs: QueueCosts) -> None:
        self._reads_costs, self._reads_between, self._costs = assigner.reads_costs, assigner.reads_between, costs
        self._lengths: dict[int, tuple[Float, ...]] = {}
        """Of the tasks that are not begun, for each motion profile; see `_length`."""
        self._able: tuple[tuple[bytes, ...], Float] = (), np.empty((0, 0))
        """The last `approach` without costs, and what it depends on."""

    def of(self, now: float, board: TaskBoard, open_tasks: Sequence[int], head: Int, aborted: Bool) -> QueueProblem:
        """Return the problem of the tasks that no robot has begun.

        Args:
            now: simulated seconds.
            board: with the tasks.
            open_tasks: indices of those that are not begun.
            head: i8[n] vertices at which robots come to rest if nothing more is released.
            aborted: bool[n]: the robot takes no task.
        """
        costs = self._costs
        jobs = [board.jobs[index] for index in open_tasks]
        self._lengths = {
            index: self._lengths.get(index) or self._length(job) for index, job in zip(open_tasks, jobs, strict=True)
        }
        lengths = np.array(
            [np.concatenate(lengths_of_task) for lengths_of_task in zip(*self._lengths.values(), strict=True)]
        )
        first, begin = _flat([job.places[0] for job in jobs])
        begun = [board.begun(robot) for robot in range(len(head))]
        place, free_in = self._free(now, begun, head)
        free_in[aborted] = np.inf
        length: Float = np.zeros((len(head), 1))
        if not self._reads_costs:
            approach = self._ability(place, first, begin, lengths)
        else:
            approach, length = np.empty((len(place), len(first))), lengths[costs.profile]
            for p in range(len(lengths)):
                robots = np.flatnonzero(costs.profile == p)
                approach[robots] = costs.seconds(p, place[robots], first)
            approach[np.isinf(length)] = np.inf
            if len(first) > len(jobs):
                total = approach + length
                spans = pairwise([*begin, len(first)])
                best = np.stack([at + total[:, at:to].argmin(axis=1) for at, to in spans], axis=1)
                approach, length = (np.take_along_axis(values, best, axis=1) for values in (approach, length))
        return QueueProblem(
            now=now,
            tasks=tuple(job.task for job in jobs),
            queues=_columns(board.queues, open_tasks),
            free_in=free_in,
            approach=approach,
            length=length,
            between=self._between(jobs, first, begin) if self._reads_between else np.empty((0, 0, 0)),
            profile=costs.profile.astype(np.int32),
            errands=tuple(job.places for job in jobs),
            ahead=tuple(() if job is None else job.places[job.errand :] for job in begun),
        )

    def _free(self, now: float, begun: Sequence[Job | None], head: Int) -> tuple[Int, Float]:
        """Where i8[n] and in how many seconds f8[n] robots have finished the tasks that they have `begun`."""
        place, free_in = head.copy(), np.zeros(len(head))
        for robot, job in enumerate(begun):
            if job is not None:
                profile = int(self._costs.profile[robot])
                (way,) = self._costs.along(profile, ((int(head[robot]),), *job.places[job.errand :]))
                free_in[robot] = way.min() + _service(job, now)
                place[robot] = job.places[-1][int(way.argmin())]
        return place, free_in

    def _ability(self, place: Int, first: Int, begin: list[int], lengths: Float) -> Float:
        """0 where a robot at a place i8[n] can do a task, inf elsewhere: f8[n,m].

        It is the same array as before as long as that is so.

        Args:
            place: of each robot.
            first: i8[k] the places of the first errands of the tasks.
            begin: where those of each of m tasks begin.
            lengths: f8[p,k] seconds from there to the end of the task, for each motion profile.
        """
        labels, profile = np.array(self._costs.labels), self._costs.profile
        here, there = labels[profile, place], np.where(np.isfinite(lengths), labels[:, first], NOWHERE)
        depends_on = here.tobytes(), there.tobytes(), np.array(begin).tobytes()
        if self._able[0] != depends_on:
            able = here[:, None] == there[profile]
            best = np.logical_or.reduceat(able, begin, axis=1)
            self._able = depends_on, read_only(np.where(best, 0.0, np.inf))
        return self._able[1]

    def _between(self, jobs: Sequence[Job], first: Int, begin: list[int]) -> Float:
        """Seconds f8[p,m,m] from the end of each task to the first errand of each."""
        last, end = _flat([job.places[-1] for job in jobs])
        between = np.array([self._costs.seconds(p, last, first) for p in range(len(self._costs.labels))])
        least: Float = np.minimum.reduceat(np.minimum.reduceat(between, end, axis=1), begin, axis=2)
        return least

    def _length(self, job: Job) -> tuple[Float, ...]:
        """For each motion profile the seconds f8[k] from each place of the first errand of a task to its end."""
        service, profiles = job.task.service.sum(), range(len(self._costs.labels))
        return tuple(self._costs.along(profile, job.places).min(axis=1) + service for profile in profiles)


def _columns(queues: Sequence[Sequence[int]], open_tasks: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """The queues of robots, with the places of tasks in `open_tasks` instead of their indices, and without others."""
    column = {index: number for number, index in enumerate(open_tasks)}
    return tuple(tuple(column[index] for index in queue if index in column) for queue in queues)


def _flat(goals: Sequence[GoalSet]) -> tuple[Int, list[int]]:
    """The vertices of sets, one after another, and where each set begins."""
    sizes = [len(goal) for goal in goals]
    return np.array([vertex for goal in goals for vertex in goal], np.int64), (np.cumsum(sizes) - sizes).tolist()


def _service(job: Job, now: float) -> float:
    """Seconds of service that a task still needs."""
    left = float(job.task.service[job.errand :].sum())
    return left if math.isnan(job.since) else max(0.0, left - (now - job.since))
