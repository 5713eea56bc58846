"""Predicted occupancy as constraints: plans keep away from it in time, and the validator sees it."""

from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_predictors_tracking.occupancy import Occupancy

from mrpbench_core.api import Budget
from mrpbench_core.api.predictor import Prediction
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem, features_of
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

BUDGET = Budget(wall_s=10.0, memory_bytes=2**30, seed=0)


def lattice(rows: int, columns: int) -> Roadmap:
    """Vertices 1 m apart; a move takes a tick of 1 s."""
    number = np.arange(rows * columns).reshape(rows, columns)
    pairs = np.vstack(
        [np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()])]
        + [np.column_stack([number[:-1].ravel(), number[1:].ravel()])]
    )
    edges = np.vstack([pairs, pairs[:, ::-1]])
    y, x = np.divmod(np.arange(rows * columns), columns)
    return Roadmap(
        position=np.column_stack([x, y]).astype(float),
        level=np.zeros(rows * columns),
        heading=np.full(rows * columns, np.nan),
        edges=edges,
        duration=np.ones((1, len(edges))),
        tick=1.0,
    )


def problem(roadmap: Roadmap, starts: list[int], goals: list[int], footprints: bool) -> Problem:
    count = len(starts)
    found = Problem(
        roadmap=roadmap,
        profile=np.zeros(count),
        radius=np.full(count, 0.2),
        start=np.array(starts),
        ready=np.zeros(count),
        goals=tuple(((goal,),) for goal in goals),
        commitments=[RobotPath(edge=np.empty(0), enter=np.empty(0), leave=np.empty(0))] * count,
        since=np.zeros(count),  # as in executions, also for planners without `Feature.SINCE`
    )
    return attrs.evolve(found, features=features_of(found) | ({Feature.FOOTPRINTS} if footprints else frozenset()))


def stands(x: float, y: float, seconds: float = 6.0, radius: float = 0.3) -> Prediction:
    """An object that stays at a place."""
    count = int(seconds / 0.1) + 1
    return Prediction(
        step=0.1, robot=np.zeros(1), place=np.tile([x, y], (1, count, 1)).astype(float), radius=np.array([radius])
    )


@pytest.mark.parametrize("footprints", [False, True], ids=["cells", "footprints"])
@pytest.mark.parametrize("planner", [Prioritized(), Cbs()], ids=["prioritized", "cbs"])
def test_a_plan_waits_in_a_corridor_until_the_predicted_object_is_gone(planner, footprints) -> None:
    asked = problem(lattice(1, 8), [0], [7], footprints)
    constrained = Occupancy().constrained(asked, stands(5.0, 0.0), now=0.0)
    assert constrained.goals[0] == asked.goals[0]
    result = planner.start().plan(constrained, BUDGET)
    assert check_plan(constrained, result.plan).valid
    path = result.plan.paths[0]
    visited = path.vertices(asked.roadmap, 0)
    assert visited[-1] == 7
    at_object = int(path.leave[np.flatnonzero(visited[1:] == 5)[0]])
    assert at_object >= 6
    assert planner.start().plan(asked, BUDGET).plan.paths[0].arrival == 7  # without it, straight on


def test_a_plan_goes_around_a_predicted_object_where_that_is_shorter() -> None:
    asked = problem(lattice(2, 8), [0], [7], True)
    constrained = Occupancy().constrained(asked, stands(4.0, 0.0, seconds=20.0), now=0.0)
    path = Prioritized().start().plan(constrained, BUDGET).plan.paths[0]
    assert path.arrival == 9
    assert 4 not in path.vertices(asked.roadmap, 0).tolist()


def test_an_object_that_passes_blocks_each_place_only_while_it_is_there() -> None:
    asked = problem(lattice(1, 8), [0], [7], True)
    times = np.arange(61) * 0.1
    way = np.column_stack([4.0 + 0 * times, -3.0 + 1.0 * times])[None]
    passing = Prediction(step=0.1, robot=np.zeros(1), place=way, radius=np.array([0.3]))
    constrained = Occupancy().constrained(asked, passing, now=10.0)
    assert len(constrained) == 2
    path = constrained.commitments[1]
    stay = np.flatnonzero(path.edge == -1)[-1]
    assert (path.enter[stay], path.leave[stay]) == (12, 14)  # at 13 s it is at the corridor, 0.5 m from it for 1 s


def test_constraints_at_the_places_of_a_door_are_left_out() -> None:
    door = Resource(name="door", kind="door", vertices=(4, 5))
    asked = problem(attrs.evolve(lattice(1, 8), resources=(door,)), [0], [7], False)
    wide = stands(4.5, 0.0, radius=1.4)
    constrained = Occupancy().constrained(asked, wide, now=0.0)
    assert [8 + place for place in (3, 6)] == constrained.start[1:].tolist()
    assert check_plan(constrained, Cbs().start().plan(constrained, BUDGET).plan).valid


def test_constraints_that_contradict_where_robots_are_committed_to_be_are_left_out() -> None:
    asked = problem(lattice(1, 8), [4], [7], True)
    assert Occupancy().constrained(asked, stands(4.0, 0.0), now=0.0) is asked
    nothing = Prediction(step=0.1, robot=np.empty(0), place=np.empty((0, 31, 2)), radius=np.empty(0))
    assert Occupancy().constrained(asked, nothing, now=0.0) is asked


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.booleans(), st.floats(0, 30))
def test_plans_meet_no_object_while_a_robot_could_touch_it(seed: int, footprints: bool, now: float) -> None:
    draw = np.random.default_rng(seed)
    roadmap = lattice(4, 6)
    starts, goals = draw.permutation(24)[:3].tolist(), draw.permutation(24)[:3].tolist()
    asked = problem(roadmap, starts, goals, footprints)
    asked = attrs.evolve(asked, ready=np.full(3, int(np.ceil(now))))
    times = np.arange(41) * 0.1
    begin, velocity = draw.uniform(-1, 6, (2, 1, 2)), draw.uniform(-1, 1, (2, 1, 2))
    prediction = Prediction(
        step=0.1, robot=np.zeros(2), place=begin + velocity * times[:, None], radius=np.array([0.3, 0.4])
    )
    constrained = Occupancy().constrained(asked, prediction, now)
    result = Prioritized().start().plan(constrained, BUDGET)
    if result.plan is None:
        return
    assert check_plan(constrained, result.plan).valid
    for robot, path in enumerate(result.plan.paths[:3]):
        visited = path.vertices(roadmap, starts[robot])
        for index in range(len(path.edge)):
            if path.edge[index] >= 0 or visited[index] in starts:
                continue
            inside = (now + times > path.enter[index]) & (now + times < path.leave[index])
            for way, radius in zip(prediction.place, prediction.radius, strict=True):
                gaps = np.hypot(*(way[inside] - roadmap.position[visited[index]]).T)
                assert (gaps >= radius + 0.2 - 1e-9).all()


def test_plans_of_an_execution_lead_around_what_is_predicted(tmp_path: Path) -> None:
    study = {
        "world": "station",
        "scenario": {"plugin": "random", "robots": 4},
        "roadmap": "grid",
        "planner": {"plugin": "ecbs", "w": 1.2},
        "dispatcher": {"plugin": "adg", "lookahead": 1},
        "simulator": "planar",
        "crowds": [{"plugin": "social_force", "people": 40}],
        "limits": {"execution": "25 s"},
        "seed": 0,
    }

    def driven(name: str, replanning: dict[str, object]) -> tuple[list[str], Float]:
        (point,) = load_study({**study, "replanning": {"period": 2.0, **replanning}}).runs
        paths = RunPaths(recording=tmp_path / f"{name}.zip", exports=tmp_path / name)
        execute(point.config, name, paths)
        recording = Recording(paths.recording)
        events = zip(recording.channel("event_kind"), recording.channel("event_detail"), strict=True)
        found = [str(detail) for kind, detail in events if kind == "replan"]
        return found, recording.channel("truth")

    without, straight = driven("without", {})
    around, led = driven("around", {"prediction": {"plugin": "constant_velocity", "horizon": 8.0}})
    assert len(without) == len(around) > 3
    assert not any("predicted" in detail for detail in around)
    assert not np.array_equal(straight, led)
