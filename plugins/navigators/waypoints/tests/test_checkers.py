import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native.navigation import ProgressChecker
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_navigators_waypoints.route_follower import RouteFollower

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.route import Route

GOAL = Route(waypoint=[[0, 0, np.nan], [1, 0, 3.14]], level=np.zeros(2), speed=np.array([np.inf]))
"""A goal of (1, 0) with the yaw 3.14."""
FILE = """
controller_server:
  ros__parameters:
    controller_frequency: 20.0
    failure_tolerance: -1.0
    goal_checker_plugins: [precise, loose]
    progress_checker_plugins: [progress]
    precise: {plugin: "nav2_controller/StoppedGoalChecker", xy_goal_tolerance: 0.15, path_length_tolerance: 1.0}
    loose: {plugin: "nav2_controller::AxisGoalChecker"}
    progress: {plugin: "nav2_controller::PoseProgressChecker", required_movement_angle: 0.3}
"""


def arrives(x, yaw, twist=(0.0, 0.0), **options):
    """Tell whether a robot that is at (x, 0) arrives."""
    follower = RouteFollower([GOAL], Waypoints(**options).arrival_rules, np.array([0.3]))
    follower.update(np.array([[x, 0.0, yaw]]), np.array([twist]), np.ones(1, np.int32), np.zeros(1, np.int16))
    return follower.reached[0] == 1


def test_a_goal_is_reached_at_the_tolerance_and_not_beyond():
    assert arrives(0.75, 3.14, xy_goal_tolerance=0.25)
    assert not arrives(0.75 - 1e-6, 3.14, xy_goal_tolerance=0.25)


def test_yaws_that_differ_by_a_turn_are_the_same():
    assert arrives(1.0, -3.14)
    assert arrives(1.0, 3.14 - 0.24)
    assert not arrives(1.0, 3.14 - 0.26)


def test_a_stopped_goal_checker_waits_until_the_robot_stands():
    stopped = {"goal_checker": "StoppedGoalChecker"}
    assert arrives(1.0, 3.14, (0.3, 0.0))
    for twist, stands in (((0.25, -0.25), True), ((0.26, 0.0), False), ((0.0, -0.26), False)):
        assert arrives(1.0, 3.14, twist, **stopped) == stands
    assert not arrives(1.0, 3.14, (0.1, 0.0), trans_stopped_velocity=0.05, **stopped)


def test_a_position_goal_checker_takes_any_yaw():
    assert arrives(1.0, 0.0, goal_checker="PositionGoalChecker")
    assert not arrives(0.8, 3.14, goal_checker="PositionGoalChecker")


def check(checker, now, pose, under_way, speed):
    """Tell which robots are stuck."""
    checker.begin(now)
    return [
        checker.is_stuck(robot, *place, under_way=bool(under_way[robot]), speed=speed[robot])
        for robot, place in enumerate(pose)
    ]


@pytest.mark.parametrize(("angle", "stuck"), [(np.inf, True), (0.5, False)])
def test_turning_is_progress_to_a_pose_progress_checker_alone(angle, stuck):
    checker, under_way = ProgressChecker(1, 0.5, 10.0, angle), np.ones(1, bool)
    free = np.full(1, np.inf)
    poses = ((now, np.array([[0.1, 0.0, 0.06 * now]])) for now in np.arange(0.0, 30.0, 0.5))
    found = [check(checker, now, pose, under_way, free)[0] for now, pose in poses]
    assert any(found) == stuck


@pytest.mark.parametrize("limit", [0.01, 0.06, 0.3])
def test_a_robot_that_drives_as_slowly_as_it_has_to_is_not_stuck_but_one_that_stands_is(limit):
    for speed, stuck in ((limit, False), (0.0, True)):
        checker = ProgressChecker(1, 0.5, 10.0, np.inf)
        poses = ((now, np.array([[speed * now, 0.0, 0.0]])) for now in np.arange(0.0, 200.0, 0.5))
        found = [check(checker, now, pose, np.ones(1, bool), np.full(1, limit))[0] for now, pose in poses]
        assert any(found) == stuck


def stuck_by_definition(control, radius, allowance, angle):
    """Yield which robots are stuck, robot by robot: an independent reading of Nav2's progress checkers."""
    known, before = {}, 0.0
    for now, pose, under_way, speed in control:
        found = []
        for robot, (x, y, yaw) in enumerate(pose):
            last = known.get(robot)
            if last is not None:
                share = min(1.0, speed[robot] * allowance / (2 * radius))
                last = *last[:3], last[3] + (1 - share) * (now - before)
            turned = last is not None and abs((yaw - last[2] + np.pi) % (2 * np.pi) - np.pi) > angle
            moved = last is None or np.hypot(x - last[0], y - last[1]) > radius or turned
            late = bool(under_way[robot]) and not moved and now - last[3] > allowance
            known[robot] = (x, y, yaw, now) if moved or late or not under_way[robot] else last
            found.append(late)
        before = now
        yield found


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1), st.sampled_from([np.inf, 0.5]))
def test_robots_are_stuck_when_they_are_by_definition(seed, angle):
    random, count, under_way = np.random.default_rng(seed), 4, np.ones(4, bool)
    pose, control = np.zeros((count, 3)), []
    for step in range(60):
        pose = pose + random.choice([0.0, 0.0, 0.0, 0.2], (count, 1)) * random.normal(size=(count, 3))
        if random.random() < 0.2:
            under_way = random.random(count) < 0.7
        speed = np.where(random.random(count) < 0.8, np.inf, random.uniform(0.01, 0.2, count))
        control.append((0.5 * step, pose, under_way, speed))
    checker = ProgressChecker(count, 0.5, 4.0, angle)
    found = [check(checker, *each) for each in control]
    assert found == list(stuck_by_definition(control, 0.5, 4.0, angle))


def test_a_nav2_file_names_the_checkers(tmp_path):
    file = tmp_path / "nav2.yaml"
    file.write_text(FILE)
    found = Waypoints(nav2=file, xy_goal_tolerance=0.2).settled()
    assert found["goal_checker"] == "StoppedGoalChecker"
    assert (found["xy_goal_tolerance"], found["yaw_goal_tolerance"], found["rot_stopped_velocity"]) == (0.2, 0.25, 0.25)
    assert (found["progress_checker"], found["required_movement_angle"]) == ("PoseProgressChecker", 0.3)
    assert found["failure_tolerance"] == np.inf
    assert set(Waypoints().idle_options()) >= {"trans_stopped_velocity", "required_movement_angle"}
    assert "trans_stopped_velocity" not in Waypoints(nav2=file).idle_options()
    notes = Waypoints(nav2=file).notes()
    assert [note for note in notes if "first" in note] == [
        f"{file}: controller_server: of precise, loose the first is used"
    ]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("StoppedGoalChecker", "AxisGoalChecker", "'AxisGoalChecker' is not supported"),
        ("xy_goal_tolerance: 0.15", "xy_goal_tolerance: 0.0", "xy_goal_tolerance"),
        ("required_movement_angle", "required_movement_angel", "unknown parameter 'required_movement_angel'"),
        ("controller_server", "planner_server", "no parameters of the node 'controller_server'"),
    ],
)
def test_a_mistake_in_a_nav2_file_is_named_with_its_place(tmp_path, old, new, message):
    file = tmp_path / "nav2.yaml"
    file.write_text(FILE.replace(old, new))
    with pytest.raises(InputError, match=message) as found:
        Waypoints(nav2=file)
    assert "nav2.yaml" in str(found.value)


def test_humble_names_one_progress_checker(tmp_path):
    file = tmp_path / "nav2.yaml"
    file.write_text("""
controller_server:
  ros__parameters:
    progress_checker_plugin: "progress_checker"
    progress_checker: {plugin: "nav2_controller::SimpleProgressChecker", required_movement_radius: 0.4}
""")
    found = Waypoints(nav2=file).settled()
    assert (found["required_movement_radius"], found["movement_time_allowance"]) == (0.4, 10.0)
    assert found["xy_goal_tolerance"] == 0.25  # of Nav2, which reads the rest of the file so
