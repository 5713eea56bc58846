from types import SimpleNamespace

import attrs
import numpy as np
import pytest
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.api import Controller, ControllerSession, Recovery
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.recovery import RecoverySession
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World

ROUTES = [Route(waypoint=[[0, y, np.nan], [1, y, np.nan]], level=np.zeros(2), speed=np.array([np.inf])) for y in (0, 5)]


class _Recorder(ControllerSession):
    def __init__(self):
        self.seen, self.cleared = [], 0

    def command(self, observation):
        self.seen.append(observation)
        return (0.1, 0.2) if observation.pose[0] >= 0 else None

    def clear(self):
        self.cleared += 1


class _Recording(Controller):
    def __init__(self):
        self.sessions = []

    def start(self, robot, world, period):
        self.sessions.append(_Recorder())
        return self.sessions[-1]


@pytest.fixture
def fleet():
    controller = _Recording()
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    session = Waypoints().start(fleet, World(name="w", levels=()), ROUTES, controller, 0.05, 0)
    return session, controller.sessions


def observe(pose, scans=()):
    return FleetObservation(
        estimate=Estimate(pose=np.array(pose, float)),
        odometry=Odometry(pose=np.zeros((2, 3)), twist=np.zeros((2, 2))),
        level=np.zeros(2),
        scans=scans,
    )


@pytest.mark.parametrize(("given", "told"), [({"xy_goal_tolerance": 0.25}, 0.1), ({"waypoint_tolerance": 0.05}, 0.05)])
def test_controllers_are_told_the_lesser_tolerance_since_paths_also_end_at_waypoints(given, told):
    controller = _Recording()
    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    session = Waypoints(**given).start(fleet, World(name="w", levels=()), ROUTES, controller, 0.05, 0)
    session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 1]))
    assert {seen.tolerance for one in controller.sessions for seen in one.seen} == {told}


def test_a_robot_under_way_gets_its_controllers_command_and_one_that_waits_stands(fleet):
    session, controllers = fleet
    motion = session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.twist.tolist() == [[0.1, 0.2], [0, 0]]
    assert motion.mode.tolist() == [Mode.FOLLOWING, Mode.WAITING]
    assert [len(controller.seen) for controller in controllers] == [1, 0]
    assert controllers[0].seen[0].path.tolist() == [[0, 0], [1, 0]]


def test_a_controller_gets_the_lesser_limit_of_route_and_dispatcher():
    routes = [attrs.evolve(route, speed=np.array([0.15])) for route in ROUTES]
    controller, fleet = _Recording(), Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    session = Waypoints().start(fleet, World(name="w", levels=()), routes, controller, 0.05, 0)
    for limits in ((), (0.1, 0.2), (np.inf, 0.05)):
        session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 1], speed=np.array(limits)))
    assert [[seen.speed for seen in each.seen] for each in controller.sessions] == [
        [0.15, 0.1, 0.15],
        [0.15, 0.15, 0.05],
    ]


def test_a_robot_whose_controller_knows_no_way_stands(fleet):
    session, _ = fleet
    motion = session.step(0.0, observe([[-0.1, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.twist.tolist() == [[0, 0], [0, 0]]


@pytest.mark.parametrize("command", [0.2, (0.2,), (0.1, 0.2, 0.3), "no", (0.1, np.nan), (np.inf, 0)])
def test_a_controller_that_returns_no_command_is_blamed_by_its_name(fleet, command):
    session, controllers = fleet
    controllers[0].command = lambda observation: command
    with pytest.raises(BrokenContractError, match=r"the controller _Recording returned (.* )?for robot 0"):
        session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))


@pytest.mark.parametrize("answer", [None, "yes", (0.1,), (np.nan, 0.0), "no session"])
def test_a_recovery_that_returns_no_command_is_blamed_by_its_name(answer):
    class OddSession(RecoverySession):
        def step(self, now, pose, twist):
            return answer

    class Odd(Recovery):
        def start(self, robot, surroundings, period):
            return SimpleNamespace() if answer == "no session" else OddSession()

    fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    session = Waypoints(recoveries=(Odd(),)).start(fleet, World(name="w", levels=()), ROUTES, _Recording(), 0.05, 0)

    def drive():
        for period in range(20):
            session.step(period * 0.05, observe([[-0.1, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))

    with pytest.raises(BrokenContractError, match=r"the recovery odd returned .*(for robot 0|of a session)"):
        drive()


def test_a_controller_gets_its_own_scan_and_only_once(fleet):
    session, controllers = fleet
    scan = ScanBatch(stamp=0.0, robot=[1, 0], ranges=[[1.0, 2.0], [3.0, 4.0]])
    session.step(0.0, observe([[0, 0, 0], [0, 5, 0]], (scan,)), Orders(released=[1, 1]))
    session.step(0.05, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 1]))
    assert [controller.seen[0].scan.ranges.tolist() for controller in controllers] == [[[3.0, 4.0]], [[1.0, 2.0]]]
    assert controllers[0].seen[1].scan is None


def test_a_robot_without_progress_tries_recoveries_in_turn_and_then_gives_up(fleet):
    session, controllers = fleet
    events, modes = [], set()
    for period in range(3000):
        motion = session.step(period * 0.05, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
        events += motion.events
        modes.add(int(motion.mode[0]))
    happened = [
        event.detail if event.kind == "recovery" else event.kind for event in events if event.kind != "recovery_failed"
    ]
    # The robot heads along its path, and does not move: all but clear and wait fail, so that the next one follows.
    attempts = [
        ["clear"],
        *[["rotate_to_path", "spin", "wait"], ["back_up", "clear"]] * 2,
        ["rotate_to_path", "spin", "wait"],
    ]
    assert happened == [word for tried in attempts for word in ("no_progress", *tried)] + ["no_progress", "aborted"]
    assert {event.robot for event in events} == {0}
    assert events[-1].detail == "no_progress"
    assert [controller.cleared for controller in controllers] == [3, 0]
    assert modes == {Mode.FOLLOWING, Mode.RECOVERING, Mode.ABORTED}
    assert motion.mode.tolist() == [Mode.ABORTED, Mode.WAITING]
    assert not motion.twist.any()
    session.adopt(ROUTES)
    motion = session.step(100.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.mode[0] == Mode.FOLLOWING


def test_a_robot_whose_controller_stays_silent_tries_recoveries_at_once(fleet):
    session, _ = fleet
    events = []
    for period in range(20):
        events += session.step(period * 0.05, observe([[-0.1, 0, 0], [0, 5, 0]]), Orders(released=[1, 0])).events
    assert [(event.kind, event.detail) for event in events[:2]] == [("no_command", ""), ("recovery", "clear")]
    assert 0.3 < events[0].stamp < 0.4


def test_a_robot_that_waits_for_release_needs_no_recovery(fleet):
    session, _ = fleet
    for period in range(1000):
        motion = session.step(period * 0.05, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[0, 0]))
        assert not motion.events


def test_a_robot_goes_round_what_blocks_its_path_and_comes_back_to_it(fleet):
    session, controllers = fleet
    around = np.array([(0.3, 0.3), (0.7, 0.3), (0.8, 0.0)])
    controllers[0].reroute = lambda observation: around
    events, ahead = [], []
    for period in range(42):
        motion = session.step(period * 0.05, observe([[0.2, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
        events += motion.events
        ahead.append(controllers[0].seen[-1].path.tolist())
    assert [event.kind for event in events] == ["detour"]
    assert ahead[0] == [[0.2, 0], [1, 0]]
    assert ahead[-1] == [[0.2, 0], *around.tolist()]
    controllers[0].reroute = lambda observation: None
    for x, y in ((0.3, 0.3), (0.7, 0.3), (0.8, 0.05)):
        session.step(2.1, observe([[x, y, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert controllers[0].seen[-1].path.tolist() == [[0.8, 0], [1, 0]]


def test_waits_ahead_are_not_cleared_by_a_robot_that_has_yet_to_stop():
    robots = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    waits = [[0, 0, np.nan], *[[1, 0, np.nan]] * 4, [1, 1, np.nan]]
    routes = [Route(waypoint=waits, level=np.zeros(6), speed=np.full(5, np.inf)), ROUTES[1]]
    navigator = Waypoints(waypoints="stop", waypoint_tolerance=0.25)
    session = navigator.start(robots, World(name="w", levels=()), routes, _Recording(), 0.05, 0)
    for period, speed in enumerate((0.2, 0.2, 0.0, 0.0)):
        seen = observe([[0.751, 0, 1.4], [0, 5, 0]])
        seen = attrs.evolve(seen, odometry=Odometry(pose=np.zeros((2, 3)), twist=np.array([[speed, 0], [0, 0]])))
        motion = session.step(period * 0.05, seen, Orders(released=[5, 0]))
        assert motion.cleared[0] <= motion.reached[0] + 1
    assert motion.reached[0] == 4


def test_a_robot_that_only_has_to_turn_goes_round_nothing():
    controller = _Recording()
    routes = [Route(waypoint=[[0, y, np.nan], [1, y, 1.5]], level=np.zeros(2), speed=[np.inf]) for y in (0, 5)]
    robots = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    session = Waypoints().start(robots, World(name="w", levels=()), routes, controller, 0.05, 0)
    controller.sessions[0].reroute = lambda observation: np.array([(0.9, 0.5), (0.5, 0.5)])
    for period in range(60):
        motion = session.step(period * 0.05, observe([[0.98, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
        assert not motion.events
    assert controller.sessions[0].seen[-1].path[-1].tolist() == [1, 0]


def test_a_way_around_that_ends_where_the_robot_is_is_none(fleet):
    session, controllers = fleet
    controllers[0].reroute = lambda observation: np.array([(0.22, 0.0)])
    for period in range(90):
        motion = session.step(period * 0.05, observe([[0.2, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
        assert not motion.events


def beside(tolerance):
    """One robot on the first route, and another; and what the first robot's controller knows."""
    controller = _Recording()
    robots = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)
    navigator = Waypoints(planner_tolerance=tolerance, xy_goal_tolerance=0.25, waypoint_tolerance=0.25)
    session = navigator.start(robots, World(name="w", levels=()), ROUTES, controller, 0.05, 0)
    asked = []

    def approach(observation, within):
        asked.append(within)
        return np.array([(0.6, 0.3), (0.8, 0.3)])

    controller.sessions[0].approach = approach
    return session, controller.sessions[0], asked


def test_an_occupied_waypoint_is_reached_as_near_as_the_robot_gets():
    session, seen, asked = beside(0.5)
    for period in range(3):
        motion = session.step(period * 0.05, observe([[0.2, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert asked == [0.5]
    assert seen.seen[-1].path.tolist() == [[0.2, 0], [0.6, 0.3], [0.8, 0.3]]
    assert motion.reached[0] == 0
    session.step(0.2, observe([[0.6, 0.3, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    motion = session.step(0.25, observe([[0.7, 0.3, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.reached[0] == 1


def test_without_a_tolerance_an_occupied_waypoint_is_waited_for():
    session, _, asked = beside(0.0)
    for period in range(100):
        session.step(period * 0.05, observe([[0.2, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert not asked


def test_robots_that_cut_corners_pass_waypoints_farther_away():
    for options, near, passing in (({}, 0.1, 0.1), ({"path_end": "release"}, 0.1, 0.5)):
        for tolerance in (None, 0.05):
            rules = Waypoints(waypoint_tolerance=tolerance, **options).arrival_rules
            assert (rules.waypoint_tolerance, rules.passing_tolerance) == (tolerance or near, tolerance or passing)
