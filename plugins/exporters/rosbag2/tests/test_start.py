import json
import math

import attrs
import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.model.common.geometry import facing
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus

NAN = math.nan


@pytest.fixture
def bag(context, tmp_path, read):
    Rosbag2(start_time=100.0).open(context, tmp_path / "bag").close()
    return read(tmp_path / "bag")


def only(messages):
    ((stamp, message),) = messages
    assert stamp == 100 * 10**9
    return message


def yaw(pose):
    return 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def test_the_run_is_named(bag):
    facts = json.loads(only(bag["/run"]).data)
    assert facts["run_id"] == "f00d"
    assert facts["world"] == "room"
    assert facts["robots"] == ["cart", "cart"]
    assert facts["plan_status"] == "solved"


def test_the_map_shows_walls_and_obstacles_where_they_stand(bag):
    grid = only(bag["/map"])
    assert grid.header.frame_id == "map"
    assert grid.info.resolution == pytest.approx(0.05)
    assert grid.info.origin.position.z == 0.5
    cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)
    assert set(np.unique(cells)) == {0, 100}

    def at(x, y):
        origin = grid.info.origin.position
        return cells[int((y - origin.y) / grid.info.resolution), int((x - origin.x) / grid.info.resolution)]

    assert [at(3, 0.5), at(0, 2), at(6.04, 4.04), at(4.5, 2.5)] == [100] * 4
    assert [at(3, 1.2), at(0.2, 2), at(4.1, 2.9), at(1, 1), at(-0.3, -0.3)] == [0] * 5


def test_a_plan_has_the_times_and_headings_of_the_path(bag):
    path = only(bag["/robot_0/plan"])
    assert path.header.frame_id == "map"
    found = [
        (pose.header.stamp.sec + pose.header.stamp.nanosec / 1e9 - 100, pose.pose.position.x, pose.pose.position.y)
        for pose in path.poses
    ]
    assert found == [(0, 1, 1), (0.5, 1, 1), (1.5, 1, 3)]
    assert all(pose.header.frame_id == "map" and pose.pose.position.z == 0.5 for pose in path.poses)
    assert [yaw(pose.pose) for pose in path.poses] == pytest.approx([math.pi / 2] * 3)


def test_a_robot_that_stays_has_a_plan_of_one_pose(bag):
    (pose,) = only(bag["/robot_1/plan"]).poses
    assert (pose.pose.position.x, pose.pose.position.y, yaw(pose.pose)) == (2, 3, pytest.approx(1))


def test_goals_take_the_heading_of_arrival_where_theirs_is_open(bag):
    for name, expected in (("robot_0", (1, 3, math.pi / 2)), ("robot_1", (2, 3, 1.0))):
        goal = only(bag[f"/{name}/goal_pose"])
        assert goal.header.frame_id == "map"
        assert (goal.pose.position.x, goal.pose.position.y, yaw(goal.pose)) == pytest.approx(expected)


def test_goals_are_drawn_in_the_colours_of_their_robots(bag):
    arrows = only(bag["/goals"]).markers
    for index, (arrow, expected) in enumerate(zip(arrows, [(1, 3, math.pi / 2), (2, 3, 1.0)], strict=True)):
        assert (arrow.ns, arrow.id, arrow.type, arrow.header.frame_id) == ("goals", index, 0, "map")
        assert (arrow.pose.position.x, arrow.pose.position.y, yaw(arrow.pose)) == pytest.approx(expected)
    assert arrows[0].color.r != arrows[1].color.r


def test_the_navigation_graph_is_drawn_with_its_names(bag):
    lanes, *names = only(bag["/navigation_graph"]).markers
    assert (lanes.ns, lanes.type) == ("lanes", 5)
    assert [(point.x, point.y, point.z) for point in lanes.points] == [
        (1, 1, 0.5),
        (1, 3, 0.5),
        (1, 3, 0.5),
        (2, 3, 0.5),
    ]
    assert [(mark.text, mark.pose.position.x, mark.pose.position.y) for mark in names] == [
        ("dock", 1, 1),
        ("shelf", 2, 3),
    ]


def test_a_run_without_a_plan_has_neither_plans_nor_goals(context, tmp_path, read):
    unplanned = attrs.evolve(context, result=PlanResult(status=PlanStatus.TIMEOUT), routes=(), goal=())
    Rosbag2().open(unplanned, tmp_path / "bag").close()
    assert set(read(tmp_path / "bag")) == {"/run", "/run_data", "/map", "/navigation_graph", "/tf_static"}


def test_every_level_has_its_map(context, tmp_path, read):
    ground = context.world.levels[0]
    upstairs = attrs.evolve(ground, name="L2", elevation=4.0)
    world = attrs.evolve(context.world, levels=(ground, upstairs))
    Rosbag2(map_resolution=0.1).open(attrs.evolve(context, world=world), tmp_path / "bag").close()
    bag = read(tmp_path / "bag")
    (_, first), (_, second) = bag["/map"][0], bag["/map_1"][0]
    assert (first.info.origin.position.z, second.info.origin.position.z) == (0.5, 4.0)
    assert list(first.data) == list(second.data)
    assert first.info.resolution == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("waypoints", "expected"),
    [
        ([[0, 0, NAN]], [0]),
        ([[0, 0, NAN], [0, 0, NAN]], [0, 0]),
        ([[0, 0, NAN], [0, 1, NAN], [0, 1, NAN], [-1, 1, NAN]], [math.pi / 2, math.pi / 2, math.pi, math.pi]),
        ([[0, 0, 3.0], [1, 0, NAN], [1, 0, 2.0]], [3.0, 0, 2.0]),
    ],
)
def test_open_headings_follow_the_drive(waypoints, expected):
    turned = facing(np.array(waypoints, float))
    assert turned[:, 2] == pytest.approx(expected)
    assert np.array_equal(turned[:, :2], np.array(waypoints)[:, :2])
