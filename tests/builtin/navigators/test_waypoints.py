import numpy as np
import pytest

from mrpbench_core.api import Controller, ControllerSession
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution import Estimate, FleetObservation, Mode, Odometry, Orders, Route, ScanBatch
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.world import World


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
    routes = [
        Route(waypoint=[[0, y, np.nan], [1, y, np.nan]], level=np.zeros(2), speed=np.array([np.inf])) for y in (0, 5)
    ]
    session = Waypoints().start(fleet, World(name="w", levels=()), routes, controller, 0.05, 0)
    return session, controller.sessions


def observe(pose, scans=()):
    return FleetObservation(
        estimate=Estimate(pose=np.array(pose, float)),
        odometry=Odometry(pose=np.zeros((2, 3)), twist=np.zeros((2, 2))),
        level=np.zeros(2),
        scans=scans,
    )


def test_a_robot_under_way_gets_its_controllers_command_and_one_that_waits_stands(fleet):
    session, controllers = fleet
    motion = session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.twist.tolist() == [[0.1, 0.2], [0, 0]]
    assert motion.mode.tolist() == [Mode.FOLLOWING, Mode.WAITING]
    assert [len(controller.seen) for controller in controllers] == [1, 0]
    assert controllers[0].seen[0].path.tolist() == [[0, 0], [1, 0]]


def test_a_robot_whose_controller_knows_no_way_stands(fleet):
    session, _ = fleet
    motion = session.step(0.0, observe([[-0.1, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
    assert motion.twist.tolist() == [[0, 0], [0, 0]]


@pytest.mark.parametrize("command", [0.2, (0.2,), (0.1, 0.2, 0.3)])
def test_a_command_that_is_no_pair_is_refused(fleet, command):
    session, controllers = fleet
    controllers[0].command = lambda observation: command
    with pytest.raises((TypeError, ValueError), match="unpack"):
        session.step(0.0, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))


def test_a_controller_gets_its_own_scan_and_only_once(fleet):
    session, controllers = fleet
    scan = ScanBatch(stamp=0.0, robot=[1, 0], ranges=[[1.0, 2.0], [3.0, 4.0]])
    session.step(0.0, observe([[0, 0, 0], [0, 5, 0]], (scan,)), Orders(released=[1, 1]))
    session.step(0.05, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 1]))
    assert [controller.seen[0].scan.ranges.tolist() for controller in controllers] == [[[3.0, 4.0]], [[1.0, 2.0]]]
    assert controllers[0].seen[1].scan is None


def test_lack_of_progress_clears_the_controller_and_is_an_event(fleet):
    session, controllers = fleet
    events = []
    for period in range(1500):
        motion = session.step(period * 0.05, observe([[0, 0, 0], [0, 5, 0]]), Orders(released=[1, 0]))
        events += motion.events
    assert [event.kind for event in events] == ["no_progress"] * 7 + ["aborted"]
    assert {event.robot for event in events} == {0}
    assert controllers[0].cleared == 7
    assert controllers[1].cleared == 0
    assert motion.mode.tolist() == [Mode.ABORTED, Mode.WAITING]
    assert not motion.twist.any()
