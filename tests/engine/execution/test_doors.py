"""Whole runs through doors, and past them."""

import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

HALL = """
name: hall
coordinate_system: cartesian_meters
levels:
  L1:
    vertices:
    - [0, 0, 0, ""]
    - [6, 0, 0, ""]
    - [6, 4, 0, ""]
    - [0, 4, 0, ""]
    - [0, 2, 0, ""]
    - [2.5, 2, 0, ""]
    - [3.5, 2, 0, ""]
    - [6, 2, 0, ""]
    - [1, 1.4, 0, west]
    - [3, 1.4, 0, front]
    - [5, 1.4, 0, east]
    - [3, 3.3, 0, room]
    - [3, 0.4, 0, south]
    - [4.4, 3.3, 0, corner]
    walls: [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [6, 7]]
    doors:
    - - 5
      - 6
      - name: [1, ward]
        type: [1, hinged]
        motion_axis: [1, start]
        motion_direction: [2, 1]
        motion_degrees: [3, 90]
    lanes:
    - [8, 9, {bidirectional: [4, true]}]
    - [9, 10, {bidirectional: [4, true]}]
    - [9, 11, {bidirectional: [4, true]}]
    - [8, 12, {bidirectional: [4, true]}]
    - [12, 10, {bidirectional: [4, true]}]
    - [11, 13, {bidirectional: [4, true]}]
"""


def run(tmp_path, starts, goals, file=None, **fields):
    pytest.importorskip("mrpbench_planners_mapf")
    (tmp_path / "hall.building.yaml").write_text(HALL)
    study = {
        "world": {"plugin": "rmf", "file": str(file or tmp_path / "hall.building.yaml")},
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": starts, "goals": goals},
        "assigner": "identity",
        "planner": "prioritized",
        "dispatcher": "adg",
        "simulator": "kinematic",
        "limits": {"execution": "15 min"},
        "control_rate": "10 Hz",
        "metrics": ["execution"],
        **fields,
    }
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None).message(), paths.recording


def test_a_robot_goes_round_the_leaf_that_it_opened_across_the_hall(tmp_path):
    """The straight way, along the leaf's side of the hall, would end before the leaf."""
    record, file = run(tmp_path, ["room"], ["west"])
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.wall_contacts"] == 0
    assert record["metrics"]["execution.robot_contacts"] == 0
    recording = Recording(file)
    opening = recording.channel("facility")
    recording.close()
    assert opening.max() == 1
    assert opening[-1].max() == 0


def test_a_robot_that_starts_in_the_swing_of_a_door_is_named_in_one_line(tmp_path):
    record, _ = run(tmp_path, ["front"], ["room"])
    assert (record["status"], record["error"]["stage"]) == ("scenario_infeasible", "scenario")
    assert record["error"]["message"] == "robot 0 starts at front, where the leaf of door ward opens"


def test_robots_change_floors_in_the_hotel(tmp_path, shared_data):
    """Three levels, two lifts, nineteen doors; one robot goes up, one comes down."""
    hotel = shared_data / "rmf/rmf_demos/hotel.building.yaml"
    record, file = run(tmp_path, ["lobby", "L2_room15"], ["L2_master_suite", "restaurant"], hotel, control_rate="5 Hz")
    assert record["status"] == "succeeded", record.get("error")
    assert record["metrics"]["execution.wall_contacts"] == record["metrics"]["execution.robot_contacts"] == 0
    recording = Recording(file)
    level, doing = recording.channel("level"), recording.channel("facility")
    recording.close()
    names = [world_level.name for world_level in Rmf(file=hotel).load().levels]
    assert [[names[number] for number in row] for row in level[[0, -1]].tolist()] == [["L1", "L2"], ["L2", "L1"]]
    assert (doing.max(axis=0) > doing.min(axis=0)).sum() >= 4, "doors and cabins move"


@pytest.mark.parametrize("planner", ["pbs", "cbs", "ecbs", "eecbs"])
def test_planners_send_robots_through_doors_and_lifts_one_at_a_time(tmp_path, shared_data, planner):
    """Both robots take the same lift; the pipeline checks the plan."""
    hotel = shared_data / "rmf/rmf_demos/hotel.building.yaml"
    places = ["lobby", "L2_room15"], ["L2_master_suite", "restaurant"]
    record, _ = run(tmp_path, *places, hotel, planner=planner, simulator="none", metrics=["planning"])
    assert record["status"] == "succeeded", record.get("error")
