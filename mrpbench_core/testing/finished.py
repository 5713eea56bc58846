"""A finished run made up for metrics and exporters: robots that drove down a corridor, one of them into a wall."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.execution import Mode
from mrpbench_core.model.plan import Plan, PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.recording import PERIODIC, Chunk
from mrpbench_core.model.run import FinishedRun, RunContext
from mrpbench_core.model.scenario import Scenario, Task
from mrpbench_core.testing.drawing import complete, grid, unit_path
from mrpbench_core.testing.room import PERIOD, ROBOT, fleet, room, route

ROBOTS = 3
SAMPLES = 41
RATE = 10.0
"""Hz of the recording"""
SPEED = 0.2
"""m/s of the first robot; the others are slower"""
BEAMS = 0 if ROBOT.lidar is None else ROBOT.lidar.beams
OWN_AXES = {
    "contact_time": ("contact",),
    "scan_time": ("scan_robot", "scan_ranges"),
    "event_time": ("event_kind", "event_robot", "event_detail"),
}
"""Channels with a time axis of their own"""
BY_ROBOT = ("contact", "scan_robot", "event_robot")
"""Channels that name robots"""


def context(result: PlanResult | None = None) -> RunContext:
    """Robots in rows of a grid of 1 m, each to drive two cells to the right; `result` instead of the plan for that."""
    problem = asked()
    starts = problem.roadmap.position[problem.start]
    ends = problem.roadmap.position[[goals[0][0] for goals in problem.goals]]
    tasks = tuple(Task(goals=np.array([(x, y, np.nan)])) for x, y in ends.tolist())
    return RunContext(
        run_id="0123456789abcdef",
        world=room(),
        fleet=fleet(ROBOTS),
        scenario=Scenario(
            start=np.column_stack([starts, np.zeros(ROBOTS)]), start_level=np.zeros(ROBOTS, np.int16), tasks=tasks
        ),
        problem=problem,
        result=result or PlanResult(status=PlanStatus.SOLVED, plan=plan(problem), statistics={"expansions": 12.0}),
        routes=tuple(route((x, y), (x + 1.0, y), (x + 2.0, y)) for x, y in starts.tolist()),
        goal=tuple((x, y, float("nan")) for x, y in ends.tolist()),
        period=PERIOD,
        assigned=tuple(range(ROBOTS)),
    )


def asked() -> Problem:
    """Each robot is to go from the first column to the third of its row."""
    return complete(grid(ROBOTS, 4), [4 * row for row in range(ROBOTS)], [(4 * row + 2,) for row in range(ROBOTS)])


def plan(problem: Problem) -> Plan:
    """Straight on."""
    ends = problem.roadmap.edges.tolist()
    steps = [[ends.index([start, start + 1]), ends.index([start + 1, start + 2])] for start in problem.start.tolist()]
    return Plan(paths=tuple(unit_path(edges) for edges in steps))


def channels() -> dict[str, NDArray[Any]]:
    """Every channel of the recording, scans and events included."""
    time = np.arange(SAMPLES) / RATE
    start = asked().roadmap.position[asked().start]
    speed = SPEED / np.arange(1, ROBOTS + 1)
    driven = time[:, None] * speed
    truth = np.zeros((SAMPLES, ROBOTS, 3))
    truth[..., 0], truth[..., 1] = start[:, 0] + driven, start[:, 1]
    twist = np.zeros((SAMPLES, ROBOTS, 2))
    twist[..., 0] = speed
    odometry = np.concatenate([truth - truth[:1], twist], axis=2)
    reached = np.minimum(2, np.floor(driven / 0.3)).astype("i4")
    scanned = np.arange(0.2, time[-1], 0.4)
    return {
        "time": time,
        "truth": truth,
        "truth_twist": twist,
        "estimate": truth + 0.01,
        "odometry": odometry,
        "command": twist,
        "level": np.zeros((SAMPLES, ROBOTS), "i2"),
        "released": np.full((SAMPLES, ROBOTS), 2, "i4"),
        "reached": reached,
        "cleared": reached,
        "mode": np.full((SAMPLES, ROBOTS), Mode.FOLLOWING, "u1"),
        "waits_for": np.full((SAMPLES, ROBOTS), -1, "i4"),
        "facility": np.zeros((SAMPLES, 0)),
        "contact_time": np.array([1.0, 1.05, 2.0]),
        "contact": np.array([(1, -1), (1, -1), (0, 2)], "i4"),
        "scan_time": scanned,
        "scan_robot": (np.arange(len(scanned)) % ROBOTS).astype("i4"),
        "scan_ranges": np.where(np.arange(BEAMS) % 2, 1.5, np.inf) + np.zeros((len(scanned), 1)),
        "event_time": np.array([1.5]),
        "event_kind": np.array(["no_progress"]),
        "event_robot": np.array([1], "i4"),
        "event_detail": np.array([""]),
    }


def finished(names: Sequence[str] | None = None) -> FinishedRun:
    """The executed run, with some channels of its recording, by default all."""
    return executed(context(), channels(), names)


def executed(
    known: RunContext, recorded: Mapping[str, NDArray[Any]], names: Sequence[str] | None = None
) -> FinishedRun:
    """A finished run with some channels of a recording; they cannot be written to."""
    loaders: dict[str, Callable[[], NDArray[Any]]] = {}
    for name, rows in recorded.items():
        rows.flags.writeable = False
        if names is None or name in names:
            loaders[name] = partial(np.asarray, rows)
    return FinishedRun(context=known, executed=True, channels=loaders)


def permuted(order: Sequence[int]) -> FinishedRun:
    """The same run with its robots in another order: robot `order[i]` becomes robot i."""
    index, known = np.array(order), context()
    renamed = np.append(np.argsort(index), -1).astype("i4")  # -1 stays -1
    problem = known.problem
    assert known.result.plan is not None
    changed = attrs.evolve(
        known,
        scenario=attrs.evolve(
            known.scenario,
            start=known.scenario.start[index],
            tasks=tuple(known.scenario.tasks[robot] for robot in order),
        ),
        problem=attrs.evolve(problem, start=problem.start[index], goals=tuple(problem.goals[robot] for robot in order)),
        result=attrs.evolve(known.result, plan=Plan(paths=tuple(known.result.plan.paths[robot] for robot in order))),
        routes=tuple(known.routes[robot] for robot in order),
        goal=tuple(known.goal[robot] for robot in order),
    )
    recorded = channels()
    for name, rows in recorded.items():
        if name in PERIODIC:
            recorded[name] = rows[:, index]
        elif name in BY_ROBOT:
            recorded[name] = renamed[rows]
    pairs = recorded["contact"]
    recorded["contact"] = np.where((pairs[:, 1:] >= 0) & (pairs[:, :1] > pairs[:, 1:]), pairs[:, ::-1], pairs)
    return executed(changed, recorded)


def chunks(seconds: float) -> list[Chunk]:
    """The recording in pieces of so many seconds, as exporters get it."""
    recorded = channels()
    axes = {"time": (*PERIODIC, "facility"), **OWN_AXES}
    pieces: list[Chunk] = []
    for begin in np.arange(0.0, recorded["time"][-1] + 1e-9, seconds):
        piece: dict[str, NDArray[Any]] = {}
        for axis, names in axes.items():
            rows = (recorded[axis] >= begin - 1e-9) & (recorded[axis] < begin + seconds - 1e-9)
            if rows.any():
                piece |= {name: recorded[name][rows] for name in (axis, *names)}
        pieces.append(piece)
    return pieces
