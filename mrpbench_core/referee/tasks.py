"""Whether tasks that come over time can have been done as a recording says: from true poses, places and times."""

from collections import defaultdict
from collections.abc import Iterator

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.execution.movers import FASTEST
from mrpbench_core.model.runs.arrivals import REST
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.motion import EXCESS, NUDGE

LATE = 1e-6
"""Seconds and metres by which numbers may be off, because they are rounded."""


@attrs.define
class _Task:
    """What is known of a task at one time of the recording."""

    release: float
    places: dict[int, list[int]] = attrs.field(factory=lambda: defaultdict(list))
    """The vertices of each errand, of which any will do; -1 = none is there."""
    service: dict[int, float] = attrs.field(factory=dict)
    """Seconds at each errand."""
    released: bool = False
    robot: int = -1
    """Of its errands."""
    errands: int = 0
    """Those that are done."""
    over: str = ""
    """How it ended."""


def tasks_fault(run: FinishedRun, driven: bool) -> str | None:
    """Return what cannot have happened to tasks, as a sentence, or None.

    Args:
        run: with tasks that come over time.
        driven: a simulator moved the robots in control periods, so that true poses say where they were.
    """
    return next(_faults(run, driven), None)


def _faults(run: FinishedRun, driven: bool) -> Iterator[str]:
    if not all(run.has(name) for name in ("task_time", "errand_time", "errand_number")):
        return
    tasks, names = _tasks(run), run.context.fleet.names
    if [*tasks] != [*range(len(tasks))]:
        yield "tasks are not numbered in the order of their release"
        return
    at_places = _Places(run) if driven else None
    busy: dict[int, int] = {}
    columns = (run.channel(f"task_{name}").tolist() for name in ("time", "index", "event", "robot", "errand"))
    for now, index, event, robot, errand in zip(*columns, strict=True):
        task = tasks.get(index)
        if task is None or not (task.released or event == "released"):
            yield f"task {index} is {event} at {now:g} s and was not released"
            return
        if now < task.release - LATE:
            yield f"task {index} is {event} at {now:g} s, before its release at {task.release:g} s"
        if task.over:
            yield f"task {index} is {event} at {now:g} s after it was {task.over}"
        if event == "released":
            if task.released:
                yield f"task {index} is released twice"
            task.released = True
        elif event in ("begun", "errand", "done"):
            yield from _does(task, index, event, robot, errand, now, busy, names)
            if event == "errand" and at_places is not None:
                fault = at_places.fault(robot, task.places[errand], task.service[errand], now)
                if fault is not None:
                    yield f"errand {errand} of task {index} is done at {now:g} s, but {names[robot]} {fault}"
        if event in ("done", "given_up", "refused"):
            task.over = event.replace("_", " ")
            if busy.get(robot) == index:
                del busy[robot]


def _does(
    task: _Task,
    index: int,
    event: str,
    robot: int,
    errand: int,
    now: float,
    busy: dict[int, int],
    names: tuple[str, ...],
) -> Iterator[str]:
    """What is wrong with the order in which a robot does the errands of a task; note what it does."""
    if not 0 <= robot < len(names):
        yield f"task {index} is done by no robot at {now:g} s"
        return
    if task.robot not in (-1, robot):
        yield f"task {index} is begun by {names[task.robot]} and done by {names[robot]}"
    task.robot = robot
    if busy.setdefault(robot, index) != index:
        yield f"{names[robot]} does task {index} at {now:g} s before it has ended task {busy[robot]}"
    if event == "errand":
        if errand != task.errands:
            yield f"errand {errand} of task {index} is done at {now:g} s out of its order"
        task.errands += 1
    if event == "done" and task.errands != len(task.places):
        yield f"task {index} is done at {now:g} s without all of its errands"


def _tasks(run: FinishedRun) -> dict[int, _Task]:
    """The tasks of a recording by their numbers, in the order of its rows."""
    vertex = run.context.problem.roadmap.locate(run.channel("errand_goal")[:, :2], run.channel("errand_level")).tolist()
    columns = (run.channel(f"errand_{name}").tolist() for name in ("task", "number", "time", "service"))
    tasks: dict[int, _Task] = {}
    for place, index, number, release, service in zip(vertex, *columns, strict=True):
        task = tasks.setdefault(index, _Task(release))
        task.places[number].append(place)
        task.service[number] = service
    return tasks


class _Places:
    """Tells whether robots were truly at places."""

    def __init__(self, run: FinishedRun) -> None:
        self._roadmap, self._tolerance = run.context.problem.roadmap, run.context.goal_tolerance
        self._time, self._truth, self._level = (run.channel(name) for name in ("time", "truth", "level"))
        self._resting = (np.abs(run.channel("truth_twist")) < REST).all(axis=2)
        pushed = FASTEST if run.context.movers else 0.0
        self._reach = [EXCESS * robot.max_speed + pushed for robot in run.context.fleet.robots]
        """Metres that each robot can move in a second."""

    def fault(self, robot: int, vertices: list[int], service: float, now: float) -> str | None:
        """Say why a robot cannot have done an errand now, after the seconds of its service, at one of the vertices."""
        first, last = np.searchsorted(self._time, [now - service - LATE, now + LATE])
        begin, end = max(0, int(first) - 1), min(int(last) + 1, len(self._time))
        time, vertex = self._time[begin:end], np.array([each for each in vertices if each >= 0], np.int64)
        outside = np.maximum(np.maximum(now - service - time, time - now), 0.0)
        away = self._away(robot, vertex, begin, end, outside <= LATE)
        allowed = self._tolerance + np.where(outside > LATE, NUDGE + self._reach[robot] * outside, LATE)
        if (away > allowed).any():
            return f"is {away[outside.argmin()]:.2f} m from its place"
        if service > 0 and not self._resting[begin:end, robot][outside <= LATE].all():
            return "does not rest there for its service time"
        return None

    def _away(self, robot: int, vertex: Int, begin: int, end: int, same_level: Bool) -> Float:
        """Metres f8[k] from some samples of a robot to the nearest of the vertices, on the `same_level` bool[k]."""
        offset = self._truth[begin:end, robot, None, :2] - self._roadmap.position[vertex]
        away = np.hypot(offset[..., 0], offset[..., 1])
        elsewhere = self._level[begin:end, robot, None] != self._roadmap.level[vertex]
        away[elsewhere & same_level[:, None]] = np.inf
        nearest: Float = away.min(axis=1, initial=np.inf)
        return nearest
