"""The built-in world of three floors."""

import numpy as np
import pytest
from mrpbench_world.facts import check_world
from mrpbench_worlds_standard.shipped import Hospital

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.store.paths import RunPaths

BURGER = Fleet(robots=(load_robot("turtlebot3_burger"),))
TRIPS = {
    "pharmacy_pickup": "ward_21_dropoff",
    "ward_22_pickup": "surgery_dropoff",
    "laboratory_pickup": "emergency_dropoff",
    "kitchen_pickup": "ward_24_dropoff",
    "L2_charger_west_south": "reception_dropoff",
    "recovery_pickup": "radiology_dropoff",
    "reception_pickup": "offices_dropoff",
    "ward_25_pickup": "sterilisation_dropoff",
    "offices_pickup": "ward_23_dropoff",
}
"""From one floor to another."""


@pytest.fixture(scope="module")
def world():
    return Hospital().load()


def test_it_has_three_floors_four_lifts_and_fifteen_doors(world):
    assert [level.name for level in world.levels] == ["L1", "L2", "L3"]
    assert {lift.name: lift.levels for lift in world.lifts} == {
        "lift_a": (0, 1, 2),
        "lift_b": (0, 1, 2),
        "lift_c": (0, 1),
        "lift_d": (1, 2),
    }
    assert [len(level.doors) for level in world.levels] == [5, 5, 5]
    assert {door.motion for level in world.levels for door in level.doors} >= {"hinged", "double_hinged", "sliding"}
    assert sum("pickup_dispenser" in vertex.parameters for vertex in world.vertices) == 15
    assert world.notes == ()


def test_its_graph_is_one_part_through_all_doors_and_lifts(world):
    roadmap = Graph().build(world, BURGER)
    assert len(np.unique(round_trips(roadmap, 0))) == 1
    assert check_world(world, roadmap, 0.125).faults == ()
    assert roadmap.notes == ()
    kinds = [resource.kind for resource in roadmap.resources]
    assert (kinds.count("door"), kinds.count("lift")) == (15, 4)


def test_robots_ride_to_the_levels_that_a_lift_serves_only(world):
    roadmap = Graph().build(world, BURGER)
    rides = [
        (lift.name, *roadmap.level[edge].tolist())
        for edge in roadmap.edges
        for lift in world.lifts
        if roadmap.level[edge[0]] != roadmap.level[edge[1]] and lift.holds(*roadmap.position[edge[0]].tolist())
    ]
    expected = {(lift.name, a, b) for lift in world.lifts for a in lift.levels for b in lift.levels if a != b}
    assert len(rides) == len(expected)
    assert set(rides) == expected


def test_hinged_doors_open_into_the_rooms(world):
    for level in world.levels:
        for door in level.doors:
            for *_, y in leaf_segments(door, 1.0):
                assert not 5.05 < y < 6.95, door.name


def run(tmp_path, planner, robots, simulator):
    pytest.importorskip("mrpbench_planners_mapf")
    starts = list(TRIPS)[:robots]
    study = {
        "world": "hospital",
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": starts, "goals": [TRIPS[start] for start in starts]},
        "assigner": "identity",
        "planner": planner,
        "simulator": simulator,
        "control_rate": "5 Hz",
        "limits": {"execution": "15 min", "planning": "60 s"},
        "metrics": ["planning"] if simulator == "none" else ["planning", "execution"],
    }
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None).message()


CASES = [(planner, robots) for planner in ("pbs", "eecbs", "cbs") for robots in (2, 5)]


@pytest.mark.parametrize(("planner", "robots"), [*CASES, ("pbs", 9)])
def test_robots_that_change_floors_get_a_plan(tmp_path, planner, robots):
    record = run(tmp_path, planner, robots, "none")
    assert record["status"] == "succeeded", record.get("error")


def test_robots_change_floors_without_contact(tmp_path):
    record = run(tmp_path, "pbs", 3, "kinematic")
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.robot_contacts"] == 0
    assert record["metrics"]["execution.wall_contacts"] == 0
