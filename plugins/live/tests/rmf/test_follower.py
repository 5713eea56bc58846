"""A robot that follows plans on a line of vertices a metre apart."""

import numpy as np
import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from mrpbench_live.fleet.paths import FleetPaths
from mrpbench_live.fleet.site import Site
from mrpbench_live.rmf.messages import messages_of, plan_key
from mrpbench_live.rmf.robots.follower import Follower, PlanFaultError

from mrpbench_core.api import Fleet, Level, Roadmap, RobotModel, World

P = "rmf_prototype_msgs/"


class Line:
    """One robot at x = 3 of a line from 0 to 9."""

    def __init__(self):
        pairs = [(i, i + 1) for i in range(9)]
        roadmap = Roadmap(
            position=[(float(i), 0.0) for i in range(10)],
            level=[0] * 10,
            heading=np.full(10, np.nan),
            edges=pairs + [(head, tail) for tail, head in pairs],
            duration=[[10] * 18],
            tick=0.1,
        )
        model = RobotModel(
            name="box",
            footprint=[(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)],
            max_speed=1.0,
            max_turn_rate=1.0,
        )
        self.site = Site(World(name="line", levels=(Level(name="ground"),)), roadmap, Fleet(robots=(model,)))
        self.paths = FleetPaths(roadmap, np.array([3]))
        self.others = {}
        self.robot = Follower(self.site, self.paths, 0, lambda name, key: self.others.get((name, key), 0.0))
        self.messages = messages_of("")

    def plan(self, *xs, version=0, blockers=(), **fields):
        waypoints = [self.messages.new(P + "Waypoint", position=[x, 0.0], progress=float(i)) for i, x in enumerate(xs)]
        for waypoint, name, other, progress in blockers:
            needed = self.messages.new(P + "TrafficDependency", name=name, plan_id=other, required_progress=progress)
            waypoints[waypoint].departure_blockers.append(needed)
        return self.messages.new(P + "Plan", waypoints=waypoints, plan_id=self.id(version), **fields)

    def id(self, version):
        return self.messages.new(P + "PlanId", plan_version=version)

    def take(self, *xs, **options):
        return self.robot.take(self.plan(*xs, **options), 0)

    def release(self, waypoint, version=0):
        self.robot.release(self.messages.new(P + "PlanRelease", waypoint_id=waypoint, plan_id=self.id(version)))

    def drive(self, moves):
        """Make some moves, which can no longer be taken back."""
        assert self.paths.allowed[0] >= self.paths.passed[0] + moves
        self.paths.passed[0] += moves
        self.paths.released[0] = max(self.paths.released[0], self.paths.passed[0])

    @property
    def way(self):
        """The places that the path leads to after the moves that are made."""
        edges = self.paths.after(0, int(self.paths.passed[0]))
        return self.site.roadmap.position[self.site.roadmap.edges[edges, 1], 0].tolist()


@pytest.fixture
def line():
    return Line()


def test_a_robot_drives_as_far_as_it_is_released(line):
    line.take(3, 5, 6)
    assert (line.way, line.paths.allowed[0]) == ([4, 5, 6], 0)
    line.release(1)
    assert line.paths.allowed[0] == 2
    line.release(2, version=1)  # of another plan
    line.release(0)  # nothing is taken back
    assert line.paths.allowed[0] == 2
    line.release(9)
    assert line.paths.allowed[0] == 3


def test_a_release_may_come_before_its_plan(line):
    line.release(1)
    line.take(3, 4, 5)
    assert line.paths.allowed[0] == 1
    line.release(2, version=1)
    line.take(3, 4, 5, version=1)
    assert line.paths.allowed[0] == 2


def test_progress_runs_from_waypoint_to_waypoint(line):
    line.take(3, 5, 6)
    assert line.robot.progress(3.0, 0.0) == (0.0, 0, 0)
    line.release(1)
    assert line.robot.progress(3.5, 0.0) == (0.25, 0, 1)
    line.drive(1)
    assert line.robot.progress(4.0, 0.0) == (0.5, 0, 1)
    assert line.robot.progress(5.0, 0.0)[0] < 1.0  # it has not reached the waypoint yet
    line.drive(1)
    assert line.robot.progress(5.0, 0.0) == (1.0, 1, 1)
    line.release(2)
    line.drive(1)
    assert line.robot.progress(6.0, 0.0) == (2.0, 2, 2)


def test_a_robot_waits_for_the_progress_that_its_blockers_need(line):
    other = line.messages.new(P + "PlanId", plan_version=4)
    line.take(3, 4, 5, blockers=[(1, "other", other, 2.0)])
    line.robot.watch()
    assert line.paths.allowed[0] == 1
    line.others["other", plan_key(line.id(5))] = 9.0  # along another plan
    line.others["other", plan_key(other)] = 1.9
    line.robot.watch()
    assert line.paths.allowed[0] == 1
    line.others["other", plan_key(other)] = 2.0
    line.robot.watch()
    assert line.paths.allowed[0] == 2


def test_a_new_plan_is_joined_where_it_leads_along_what_is_released(line):
    line.take(3, 4, 5, 6, 7)
    line.release(4)
    line.drive(1)
    line.paths.released[0] = 3  # until x = 6
    assert "after move 1" in line.take(4, 5, 6, 5, version=1)
    assert line.way == [5, 6, 5]
    assert line.robot.progress(4.0, 0.0) == (0.0, 0, 0)
    line.release(3, version=1)
    assert line.paths.allowed[0] == 4
    line.drive(2)
    assert line.robot.progress(6.0, 0.0) == (2.0, 2, 3)


def test_a_robot_returns_to_a_plan_that_leads_elsewhere(line):
    line.take(3, 4, 5, 6)
    line.release(3)
    line.drive(1)
    line.paths.released[0] = 2  # until x = 5
    assert "from the end of what is released" in line.take(4, 3, version=1)
    assert line.way == [5, 4, 3]
    assert line.paths.allowed[0] == 3  # to the first waypoint it may
    assert line.robot.progress(4.5, 0.0) == (0.0, 0, 0)


def test_a_plan_that_is_known_changes_nothing(line):
    line.take(3, 4)
    line.release(1)
    line.drive(1)
    assert line.take(3, 4) is None
    assert line.robot.progress(4.0, 0.0) == (1.0, 1, 1)


@pytest.mark.parametrize(
    ("xs", "fields", "reason"),
    [
        ((), {}, "no waypoints"),
        ((3, 99), {}, "not on the roadmap"),
        ((3, 4), {"workflow": "{}"}, "workflows"),
    ],
)
def test_a_plan_that_cannot_be_followed_leaves_the_path_alone(line, xs, fields, reason):
    line.take(3, 4, 5)
    with pytest.raises(PlanFaultError, match=reason):
        line.take(*xs, version=1, **fields)
    assert line.way == [4, 5]
    line.release(2)
    assert line.paths.allowed[0] == 2


def test_actions_and_unknown_maps_are_refused(line):
    for field, value, reason in (("arrival_action", "dock", "action"), ("maps", ["moon"], "unknown maps: moon")):
        plan = line.plan(3, 4)
        setattr(plan.waypoints[1], field, value)
        with pytest.raises(PlanFaultError, match=reason):
            line.robot.take(plan, 0)
