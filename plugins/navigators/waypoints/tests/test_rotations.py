"""Robots of a rotation stand and face their way before they drive, and none leads the others."""

import attrs
import numpy as np
import pytest
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_navigators_waypoints.rotations import FACING, LEAD, OFFSET
from mrpbench_tests.execution.rings import ring_problem

from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.model.worlds.world import Level, World

PERIOD, CELL = 0.05, 0.4


class _Ring:
    """Four robots that rotate once, each moved exactly as it is commanded; `stuck` robots do not move."""

    def __init__(self, pose, stuck=()):
        fleet, problem, plan = ring_problem(CELL, 1, 1, 0)
        self.start = problem.roadmap.position[problem.start]
        routes = Router(problem, np.full(4, np.nan), np.full(len(problem.roadmap.edges), np.inf))(plan)
        self.along = np.array([route.waypoint[1, :2] - route.waypoint[0, :2] for route in routes]) / CELL
        controller = pytest.importorskip("mrpbench_controllers_pure_pursuit").PurePursuit()
        world = World(name="empty", levels=(Level(name="L1"),))
        self.navigator = Waypoints().start(fleet, world, routes, controller, PERIOD, 0)
        self.pose, self.stuck = np.array(pose, float), list(stuck)
        self.orders = Orders(released=np.ones(4, "i4"), in_step=(tuple((robot, 0) for robot in range(4)),))
        self.twist = np.zeros((4, 2))

    def step(self, now):
        seen = FleetObservation(
            estimate=Estimate(pose=self.pose),
            odometry=Odometry(pose=self.pose, twist=self.twist),
            level=np.zeros(4, np.int16),
            scans=(),
        )
        motion = self.navigator.step(now, seen, self.orders)
        self.twist = motion.twist.copy()
        self.twist[self.stuck] = 0.0
        yaw = self.pose[:, 2]
        self.pose = self.pose + PERIOD * np.column_stack(
            [self.twist[:, 0] * np.cos(yaw), self.twist[:, 0] * np.sin(yaw), self.twist[:, 1]]
        )
        return motion

    @property
    def driven(self):
        return ((self.pose[:, :2] - self.start) * self.along).sum(axis=1)


def _pose(ring_offset, yaw):
    _, problem, _ = ring_problem(CELL, 1, 1, 0)
    return np.column_stack([problem.roadmap.position[problem.start] + ring_offset, yaw])


@pytest.mark.parametrize("seed", range(5))
def test_all_settle_and_face_their_way_before_any_drives_and_none_leads(seed):
    random = np.random.default_rng(seed)
    ring = _Ring(_pose(random.uniform(-0.06, 0.06, (4, 2)), random.uniform(-np.pi, np.pi, 4)))
    heading = np.arctan2(ring.along[:, 1], ring.along[:, 0])
    allowed = ring.driven.clip(min=2 * OFFSET) + LEAD
    for step in range(600):
        motion = ring.step(step * PERIOD)
        if ring.driven.min() <= 2 * OFFSET:
            assert (ring.driven <= allowed).all()
            continue
        assert np.ptp(ring.driven) <= LEAD + OFFSET
        assert (np.abs(wrapped(ring.pose[:, 2] - heading)) < 5 * FACING).all()
        if (motion.reached == 1).all():
            break
    assert (motion.reached == 1).all()


def test_a_robot_that_cannot_move_stops_its_group_which_gives_up():
    ring = _Ring(_pose((0.0, 0.0), np.zeros(4)), stuck=[1])
    events = [event for step in range(4000) for event in ring.step(step * PERIOD).events]
    assert {event.robot for event in events if event.kind == "no_progress"} == {0, 1, 2, 3}
    assert {event.robot for event in events if event.kind == "aborted"} == {0, 1, 2, 3}
    assert ring.driven.max() < LEAD


def test_a_robot_that_starts_late_is_not_commanded_before():
    ring = _Ring(_pose((0.0, 0.0), np.zeros(4)))
    ring.orders = attrs.evolve(ring.orders, released=np.array([1, 1, 0, 1], "i4"))
    for step in range(100):
        ring.step(step * PERIOD)
        assert (ring.twist[2] == 0).all()
    assert ring.driven.max() < LEAD


def test_waiting_for_the_others_to_turn_is_no_lack_of_progress():
    ring = _Ring(_pose((0.0, 0.0), np.zeros(4)))
    events = []
    for step in range(600):
        motion = ring.step(step * PERIOD)
        events += motion.events
    assert (motion.reached == 1).all()
    assert not events
