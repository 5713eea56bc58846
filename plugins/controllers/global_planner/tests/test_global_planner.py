import attrs
import numpy as np
import pytest
from mrpbench_controllers_global_planner import GlobalPlanner
from mrpbench_controllers_global_planner.session import ahead
from mrpbench_controllers_local.costmap import LocalCostmap
from mrpbench_tests.fixtures.following import SPRINTER, seen

from mrpbench_core.api import Controller, FleetControllerSession
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import Level, Vertex, World

WALLED = World(
    name="walled",
    levels=(Level(name="L1", walls=np.array([(1.5, -0.6, 1.5, 2.0)])),),
    vertices=(Vertex(name="start", x=0.0, y=0.0), Vertex(name="goal", x=3.0, y=0.0)),
)
KNOWN = LocalCostmap(plugins=("static_layer", "inflation_layer"))
WAY = [(0.0, 0.0), (3.0, 0.0)]


class _Follower(FleetControllerSession):
    """Keeps the path that it is given."""

    def __init__(self):
        super().__init__(())
        self.path = None

    def clear(self, robot):
        pass

    def command(self, observations):
        self.path = observations.path(0) if len(observations.robot) else None
        return np.full((len(observations.robot), 2), 0.5)


class Follower(Controller):
    def start(self, robot, world, period):
        raise NotImplementedError

    def start_fleet(self, robots, world, period, seed=0):
        self.sessions.append(_Follower())
        return self.sessions[-1]

    sessions = []  # noqa: RUF012


def planner(world=WALLED, **options):
    session = GlobalPlanner(primary_controller=Follower(), **options).start_fleet((SPRINTER,), world, 0.05)
    return session, Follower.sessions[-1]


def with_gap(observations, first, last):
    """Let the beams `first` to `last` (degrees) return nothing nearer than 4 m."""
    (scan,) = observations.scans
    ranges = scan.ranges.copy()
    ranges[0, first:last] = 4.0
    return attrs.evolve(observations, scans=(attrs.evolve(scan, ranges=ranges),))


def length_of(path):
    return np.hypot(*np.diff(path, axis=0).T).sum()


def test_a_robot_that_has_seen_nothing_plans_straight_through_walls():
    session, follower = planner()
    assert session.command(seen(WAY)) == pytest.approx(0.5)
    assert follower.path[-1].tolist() == [3.0, 0.0]
    assert length_of(follower.path) == pytest.approx(3.0, abs=0.05)


def test_on_the_known_map_the_path_leads_around_walls_and_is_short():
    session, follower = planner(global_costmap=KNOWN)
    session.command(seen(WAY))
    end_of_wall = np.array([(1.5, -0.65)])  # with half the thickness
    corner = end_of_wall - (0.0, 0.16)  # a robot of this inscribed radius passes
    shortest = length_of(np.vstack([(0.0, 0.0), corner, (3.0, 0.0)]))
    assert shortest <= length_of(follower.path) <= 1.2 * shortest
    dense = np.vstack([np.linspace(*leg, 50) for leg in zip(follower.path[:-1], follower.path[1:], strict=True)])
    beside = np.abs(dense[:, 0] - 1.5) < 0.05
    assert beside.any()
    assert (dense[beside, 1] < -0.65).all()


def test_an_enclosed_robot_has_no_path_until_its_costmap_is_cleared():
    session, follower = planner()
    assert np.isnan(session.command(seen(WAY, ranges=1.0))).all()
    assert follower.path is None
    assert session.failure_reason(0) == "no path to the goal"
    session.clear(0)
    assert session.command(seen(WAY, now=0.05)) == pytest.approx(0.5)


def test_the_path_leads_through_the_gap_that_the_lidar_has_seen():
    session, follower = planner()
    session.command(with_gap(seen(WAY, ranges=1.0), 60, 120))
    leaves = follower.path[np.hypot(*follower.path.T) > 0.9][0]
    assert 60 <= np.degrees(np.arctan2(leaves[1], leaves[0])) <= 120


def test_robots_plan_again_with_the_given_frequency_and_to_new_goals_at_once():
    session, follower = planner(replan_frequency=2.0, global_costmap=LocalCostmap(update_frequency=20.0))
    session.command(seen(WAY))
    gap = with_gap(seen(WAY, ranges=1.0, now=0.2), 60, 120)
    session.command(gap)
    assert length_of(follower.path) == pytest.approx(3.0, abs=0.05)
    session.command(attrs.evolve(gap, now=0.5))
    assert length_of(follower.path) > 3.2
    session.command(seen([(0.0, 0.0), (0.0, 2.0)], now=0.6))
    assert follower.path[-1].tolist() == [0.0, 2.0]


def test_a_path_begins_at_the_nearest_point():
    path = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0)])
    foot, rest = ahead(path, np.array([1.0, 0.3]))
    assert foot.tolist() == [1.0, 0.0]
    assert rest.tolist() == [[2.0, 0.0], [2.0, 2.0]]
    foot, rest = ahead(path, np.array([3.0, 9.0]))
    assert foot.tolist() == [2.0, 2.0]
    assert rest.tolist() == [[2.0, 2.0]]
    foot, rest = ahead(path[:1], np.array([3.0, 9.0]))
    assert foot.tolist() == [0.0, 0.0]
    assert len(rest) == 1


def test_worlds_of_several_levels_and_costmaps_that_are_too_large_are_refused():
    two = World(name="two", levels=(Level(name="L1"), Level(name="L2")))
    with pytest.raises(InputError, match="plans on one level, and two has 2"):
        planner(two)
    with pytest.raises(InputError, match="3 to 2000 cells"):
        planner(global_costmap=LocalCostmap(resolution=0.001))
