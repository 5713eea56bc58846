"""Buildings drawn at random in the format of the traffic editor: what the reader finds, and plans between floors."""

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.buildings import MOST_DOORS, MOST_LIFTS, random_building
from mrpbench_tests.instances.problems import problem_on
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.store.paths import RunPaths

FLEET = Fleet(robots=(load_robot("turtlebot3_burger"),))
BUDGET = Budget(wall_s=300.0, memory_bytes=1 << 30)
PIXEL = 1e-3
"""metres: what the rounding of pixels makes out."""
seeds = st.integers(0, 2**32 - 1)
with_files = settings(deadline=None, max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture])


def loaded(tmp_path, building):
    file = tmp_path / "drawn.building.yaml"
    file.write_text(building.text)
    return Rmf(file=file).load()


@with_files
@given(seed=seeds)
def test_the_reader_finds_places_lifts_and_doors_where_they_were_drawn(tmp_path, seed):
    building = random_building(np.random.default_rng(seed))
    world = loaded(tmp_path, building)
    assert world.notes == ()
    names = [level.name for level in world.levels]
    assert names == list(building.places)
    found = {vertex.name: vertex for vertex in world.vertices if vertex.name}
    drawn = {name: (level, at) for level, places in building.places.items() for name, at in places.items()}
    assert found.keys() == drawn.keys()
    for name, (level, at) in drawn.items():
        assert names[found[name].level] == level
        assert (found[name].x, found[name].y) == pytest.approx(at, abs=PIXEL)
    assert len(world.lifts) <= MOST_LIFTS
    assert {lift.name: tuple(names[level] for level in lift.levels) for lift in world.lifts} == {
        name: floors for name, (_, floors) in building.lifts.items()
    }
    for lift in world.lifts:
        assert (lift.x, lift.y) == pytest.approx(building.lifts[lift.name][0], abs=PIXEL)
    doors = {door.name: door for level in world.levels for door in level.doors}
    assert {name: door.motion for name, door in doors.items()} == building.doors
    assert len(doors) <= MOST_DOORS
    for name, tip in building.tips.items():
        assert leaf_segments(doors[name], 1.0)[0, 2:] == pytest.approx(tip, abs=PIXEL), name


@with_files
@given(seed=seeds)
def test_the_door_of_every_lift_is_in_the_wall_of_the_corridor_on_the_floors_that_it_serves(tmp_path, seed):
    building = random_building(np.random.default_rng(seed))
    world = loaded(tmp_path, building)
    roadmap = Graph().build(world, FLEET)
    for lift in world.lifts:
        assert sum(vertex.lift == lift.name for vertex in world.vertices) == len(lift.levels)
    lifts = {resource.name for resource in roadmap.resources if resource.kind == "lift"}
    assert lifts == set(building.lifts)
    label = round_trips(roadmap, 0)
    main = np.bincount(label).argmax()
    assert set(roadmap.level[label == main].tolist()) == set(range(len(world.levels)))


@pytest.mark.parametrize("name", ["pbs.Pbs", "bounded.Eecbs", "cbs.Cbs"])
@settings(deadline=None, max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])
@example(seed=6925187, robots=2)  # PBS gives up
@given(seed=seeds, robots=st.integers(2, 3))
def test_robots_that_change_floors_get_plans(tmp_path, name, seed, robots):
    module, planner = name.split(".")
    planners = pytest.importorskip(f"mrpbench_planners_mapf.{module}")
    random = np.random.default_rng(seed)
    roadmap = Graph().build(loaded(tmp_path, random_building(random, lifts=4)), FLEET)
    label = round_trips(roadmap, 0)
    used = [vertex for resource in roadmap.resources for vertex in resource.vertices]
    places = np.setdiff1d(roadmap.place[roadmap.place >= 0], used)
    places = random.permutation(places[label[places] == np.bincount(label).argmax()])
    starts = places[roadmap.level[places] == 0][:robots].tolist()
    goals = places[roadmap.level[places] > 0][:robots].tolist()
    problem = problem_on(roadmap, starts, goals, radius=float(FLEET.radii.max()))
    assert Feature.RESOURCES in problem.features
    result = getattr(planners, planner)().plan(problem, BUDGET)
    if planner == "Pbs" and result.status is PlanStatus.GAVE_UP:
        return  # some problems have no plan in which one robot always gives way to the other
    assert result.status is PlanStatus.SOLVED
    assert check_plan(problem, result.plan).valid


def twins(building):
    """Tell whether two lifts stand side by side."""
    at = [centre for centre, _ in building.lifts.values()]
    return any(np.isclose(np.hypot(*np.subtract(one, other)), 1.8) for one in at for other in at)


@pytest.mark.parametrize("side_by_side", [False, True], ids=["one lift", "two lifts side by side"])
def test_robots_that_queue_at_lifts_change_floors_without_contact(tmp_path, side_by_side):
    pytest.importorskip("mrpbench_planners_mapf")
    lifts = 2 if side_by_side else 1
    drawn = (random_building(np.random.default_rng(seed), floors=2, lifts=lifts, lanes=2) for seed in range(100))
    building = next(building for building in drawn if twins(building) == side_by_side)
    file = tmp_path / "drawn.building.yaml"
    file.write_text(building.text)
    up, down = (sorted(name for name in places if "west" in name) for places in building.places.values())
    study = {
        "world": {"plugin": "rmf", "file": str(file)},
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": [*up[:2], down[0]], "goals": [*down[1:3], up[2]]},
        "assigner": "identity",
        "planner": "pbs",
        "simulator": "kinematic",
        "control_rate": "5 Hz",
        "limits": {"execution": "15 min", "planning": "60 s"},
        "metrics": ["execution"],
    }
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert record["metrics"]["execution.wall_contacts"] == 0
