"""Small finished runs, written by hand; as fixtures that build them, since test folders are no packages."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.run import FinishedRun, RunContext
from mrpbench_core.model.worlds.world import World

LINE = Roadmap(
    position=[[0, 0], [3, 0], [6, 0], [0, 4]],
    level=[0] * 4,
    heading=[np.nan] * 4,
    edges=[[0, 1], [1, 2], [2, 1], [1, 0], [0, 3]],
    duration=[[2, 2, 2, 2, 3]],
    tick=0.5,
)


def disc(radius):
    return RobotModel(
        name=f"disc {radius}", footprint=[[radius, 0], [0, radius], [-radius, 0]], max_speed=1, max_turn_rate=1
    )


def _planned(paths, starts, status=PlanStatus.SOLVED, **result):
    """A run that ended after planning on `LINE`."""
    count = len(starts)
    start = [(*LINE.position[vertex], np.nan) for vertex in starts]
    problem = Problem(
        roadmap=LINE, profile=[0] * count, radius=[0.1] * count, start=starts, ready=[0] * count, goals=((),) * count
    )
    context = RunContext(
        run_id="0",
        world=World(name="line", levels=()),
        fleet=Fleet(robots=(disc(0.1),) * count),
        scenario=Scenario(start=start, start_level=[0] * count, tasks=tuple(Task(goals=[pose]) for pose in start)),
        problem=problem,
        result=PlanResult(status=status, plan=None if paths is None else Plan(paths=tuple(paths)), **result),
        routes=(),
        goal=(),
    )
    return FinishedRun(context=context, executed=False)


def _executed(time, tracks, reached, waypoints, radii=None, level=None, contacts=()):
    """A run whose robots truly were at `tracks`[robot][sample] = (x, y) at `time`."""
    count = len(tracks)
    base = _planned(None, [0] * count).context
    routes = tuple(
        Route(waypoint=[(x, y, np.nan) for x, y in points], level=[0] * len(points), speed=[np.inf] * (len(points) - 1))
        for points in waypoints
    )
    context = attrs.evolve(
        base,
        fleet=Fleet(robots=tuple(disc(radius) for radius in radii or [0.1] * count)),
        routes=routes,
        goal=tuple((*points[-1], float("nan")) for points in waypoints),
    )
    position = np.array(tracks, float).transpose(1, 0, 2)
    channels = {
        "time": np.array(time, float),
        "truth": np.concatenate([position, np.zeros((*position.shape[:2], 1))], axis=2),
        "reached": np.array(reached, "i4").T,
        "level": np.zeros(position.shape[:2], "i2") if level is None else np.array(level, "i2").T,
        "contact_time": np.array([stamp for stamp, _, _ in contacts], float),
        "contact": np.array([pair for _, *pair in contacts], "i4").reshape(-1, 2),
    }
    return FinishedRun(
        context=context,
        executed=True,
        channels={name: lambda rows=rows: rows for name, rows in channels.items()},
    )


def _permuted(run, order):
    """The same run with its robots in another order: robot `order[i]` becomes robot i."""
    index = np.array(order)
    context = run.context
    old = {name: load() for name, load in run.channels.items()}
    renamed = np.append(np.argsort(index), -1)  # the wall stays -1
    new = {name: rows[:, index] if name in ("truth", "reached", "level") else rows for name, rows in old.items()}
    new["contact"] = renamed[old["contact"]].astype("i4")
    return attrs.evolve(
        run,
        context=attrs.evolve(
            context,
            fleet=Fleet(robots=tuple(context.fleet.robots[i] for i in order)),
            routes=tuple(context.routes[i] for i in order),
            goal=tuple(context.goal[i] for i in order),
        ),
        channels={name: lambda rows=rows: rows for name, rows in new.items()},
    )


@pytest.fixture(scope="session")
def planned():
    return _planned


@pytest.fixture(scope="session")
def executed():
    return _executed


@pytest.fixture(scope="session")
def permuted():
    return _permuted


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""
