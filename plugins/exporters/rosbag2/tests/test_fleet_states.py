"""`/fleet_states`, read with a reader that has only the definition in the bag."""

import attrs
import numpy as np
import pytest
from mcap.reader import make_reader
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.worlds.world import Level

FIELDS = {  # of Location and RobotMode, in the documentation of rmf_fleet_msgs 1.4, 3.0 and 4.0
    "galactic": (["t", "x", "y", "yaw", "level_name", "index"], ["mode", "mode_request_id"]),
    "humble": (
        ["t", "x", "y", "yaw", "obey_approach_speed_limit", "approach_speed_limit", "level_name", "index"],
        ["mode", "mode_request_id"],
    ),
    "rolling": (
        ["t", "x", "y", "yaw", "obey_approach_speed_limit", "approach_speed_limit", "level_name", "index"],
        ["mode", "mode_request_id", "performing_action"],
    ),
}


def export(context, chunk, destination, **options):
    session = Rosbag2(topics=("/fleet_states",), **options).open(context, destination)
    session.write(chunk)
    session.close()
    return destination


def test_says_twice_a_second_where_the_robots_believe_to_be(context, recording, tmp_path, read):
    said = read(export(context, recording, tmp_path / "bag", start_time=100.0))["/fleet_states"]
    assert [stamp for stamp, _ in said] == [100 * 10**9 + 5 * 10**8 * step for step in range(9)]
    for number, (stamp, message) in enumerate(said):
        assert message.name == "mrpbench"
        assert [robot.name for robot in message.robots] == ["robot_0", "robot_1"]
        for robot, belief in zip(message.robots, recording["estimate"][number * 10], strict=True):
            place = robot.location
            assert place.t.sec * 10**9 + place.t.nanosec == stamp
            assert (place.x, place.y, place.yaw) == tuple(belief.astype("f4").tolist())
            assert (place.level_name, robot.seq, robot.model) == ("L1", number, "cart")
            assert 0 <= robot.battery_percent <= 100


def test_modes_are_those_of_rmf(context, recording, tmp_path, read):
    mode = recording["mode"].copy()
    mode[10:20, 0], mode[20:30, 0], mode[30:, 0] = Mode.WAITING, Mode.RECOVERING, Mode.ABORTED
    reached = recording["reached"].copy()
    reached[70:, 0] = 2  # of two segments; robot 1 is where it is to be from the beginning
    said = read(export(context, recording | {"mode": mode, "reached": reached}, tmp_path / "bag"))["/fleet_states"]
    moving, waiting, stuck, idle = 2, 4, 8, 0
    found = [[robot.mode.mode for robot in message.robots] for _, message in said]
    assert [first for first, _ in found] == [moving, waiting, moving, stuck, stuck, stuck, stuck, idle, idle]
    assert {second for _, second in found} == {idle}


def test_levels_are_named_as_robots_change_them(context, recording, tmp_path, read):
    world = context.world
    above = Level(name="the floor above", elevation=4.0)
    context = attrs.evolve(context, world=attrs.evolve(world, levels=(*world.levels, above)))
    level = recording["level"].copy()
    level[25:60, 1] = 1
    chunks = export(context, recording | {"level": level}, tmp_path / "bag")
    names = [[robot.location.level_name for robot in message.robots] for _, message in read(chunks)["/fleet_states"]]
    below = above.name
    assert [first for first, _ in names] == ["L1"] * 9
    assert [second for _, second in names] == ["L1"] * 3 + [below] * 3 + ["L1"] * 3


@pytest.mark.parametrize("release", FIELDS)
def test_definitions_are_those_of_the_release(context, recording, tmp_path, read, release):
    bag = export(context, recording, tmp_path / "bag", rmf=release)
    with (bag / "bag.mcap").open("rb") as file:
        (schema,) = make_reader(file).get_summary().schemas.values()
    parts = schema.data.decode().split("=" * 80 + "\n")
    listed = {}
    for part in parts[1:]:
        head, *lines = part.strip().splitlines()
        listed[head.removeprefix("MSG: ")] = [line.split()[1] for line in lines if line]
    assert (listed["rmf_fleet_msgs/Location"], listed["rmf_fleet_msgs/RobotMode"]) == FIELDS[release]
    assert np.isclose(read(bag)["/fleet_states"][-1][1].robots[0].location.x, recording["estimate"][-1, 0, 0])
