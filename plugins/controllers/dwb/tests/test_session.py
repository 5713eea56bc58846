import math

import attrs
import numpy as np
import pytest
from mrpbench_controllers_dwb import BaseObstacle, Critic, CriticSession, Dwb, GoalDist, LocalCostmap

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Lidar, RobotModel
from mrpbench_core.model.execution.observation import Observations, ScanBatch
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.fixtures.room import PERIOD, driven

BURGER = load_robot("turtlebot3_burger")
WAFFLE = load_robot("turtlebot3_waffle")
AGV = RobotModel(
    name="agv",
    footprint=np.array([(0.3, 0.25), (-0.3, 0.25), (-0.3, -0.25), (0.3, -0.25)]),
    max_speed=1.0,
    max_turn_rate=0.8,
    acceleration=0.5,
    turn_acceleration=1.0,
    lidar=Lidar(beams=180, range=10.0),
)
NOWHERE = World(name="w", levels=())


def look(now, pose, twist, path, scans=()):
    """Observations of robots whose paths have equally many points."""
    count, points = path.shape[:2]
    return Observations(
        now=now,
        robot=np.arange(count),
        pose=pose,
        twist=twist,
        foot=np.ascontiguousarray(path[:, 0]),
        points=np.ascontiguousarray(path[:, 1:]).reshape(-1, 2),
        begin=np.arange(count) * (points - 1),
        end=(np.arange(count) + 1) * (points - 1),
        yaw=np.full(count, math.nan),
        speed=np.full(count, math.inf),
        fleet_pose=pose,
        scans=scans,
    )


def wander(session, robots, periods=40, seed=1, ahead=False):
    """Commands and poses of robots that follow straight paths among things that only they see.

    `ahead`: scans are observed before the command, and a costmap is read at once.
    """
    random = np.random.default_rng(seed)
    count = len(robots)
    pose = random.uniform((-9, -9, -3), (9, 9, 3), (count, 3))
    goal = pose[:, :2] + random.uniform(-2, 2, (count, 2))
    twist, poses, commands = np.zeros((count, 2)), [], []
    for period in range(periods):
        beams = random.uniform(0.5, 4.0, (count, 90))
        scan = ScanBatch(stamp=period * PERIOD, robot=np.arange(count), ranges=beams)
        path = np.stack([pose[:, :2], goal], axis=1)
        seen = look(period * PERIOD, pose, twist, path, (scan,) if period % 4 == 0 else ())
        if ahead:
            session.observe(seen.now, seen.scans, pose)
            read = session.costmap(period % count)[0]
        said = session.command(seen)
        if ahead and seen.scans:
            assert read.any()
            assert read.tobytes() == session.costmap(period % count)[0].tobytes()
        commands.append(said)
        twist = np.nan_to_num(said)
        pose = driven(pose, twist, PERIOD)
        poses.append(pose)
    return np.array(commands), np.array(poses)


@pytest.mark.parametrize("threads", [2, 5])
def test_results_do_not_depend_on_threads(threads):
    robots = (BURGER,) * 7 + (WAFFLE,) * 2
    one, other = (wander(Dwb(threads=number).start_fleet(robots, NOWHERE, PERIOD), robots) for number in (1, threads))
    assert one[0].tobytes() == other[0].tobytes()


@pytest.mark.parametrize("threads", [1, 3])
def test_scans_may_be_observed_before_the_command(threads):
    robots = (BURGER,) * 7 + (WAFFLE,) * 2
    one, other = (
        wander(Dwb(threads=threads).start_fleet(robots, NOWHERE, PERIOD), robots, ahead=ahead)
        for ahead in (False, True)
    )
    assert one[0].tobytes() == other[0].tobytes()


def test_equal_runs_agree_to_the_last_bit():
    one, other = (wander(Dwb().start_fleet((BURGER,) * 4, NOWHERE, PERIOD), (BURGER,) * 4) for _ in range(2))
    assert one[0].tobytes() == other[0].tobytes()


def test_looking_closely_at_all_trajectories_changes_no_command():
    robots = (BURGER,) * 8
    lazy, thorough = (
        wander(Dwb(short_circuit_trajectory_evaluation=short).start_fleet(robots, NOWHERE, PERIOD), robots, seed=3)
        for short in (True, False)
    )
    assert lazy[0].tobytes() == thorough[0].tobytes()


def test_each_robot_of_a_mixed_fleet_drives_by_its_own_limits_and_footprint():
    robots = (BURGER, WAFFLE, AGV)
    session = Dwb().start_fleet(robots, NOWHERE, PERIOD)
    pose = np.array([(0.0, 0.0, 0.0), (0.0, 9.0, 0.0), (0.0, 20.0, 0.0)])
    twist, fastest = np.zeros((3, 2)), np.zeros(3)
    for period in range(100):
        end = np.column_stack([np.full(3, 40.0), [0.0, 9.0, 20.0]])
        path = np.stack([np.column_stack([pose[:, 0], [0.0, 9.0, 20.0]]), end], axis=1)
        twist = session.command(look(period * PERIOD, pose, twist, path))
        fastest = np.maximum(fastest, twist[:, 0])
        pose = driven(pose, twist, PERIOD)
    assert (fastest <= [0.22, 0.26, 1.0]).all()
    assert (fastest >= np.array([0.22, 0.26, 0.4]) * 0.85).all()
    assert np.abs(pose[:, 1] - [0.0, 9.0, 20.0]).max() < 0.05
    inscribed = [session.costmap(robot)[3] for robot in range(3)]
    for radius, robot in zip(inscribed, robots, strict=True):
        assert robot.radius * 0.98 < radius < robot.radius + 0.012


@pytest.mark.parametrize("yaw", [math.nan, 0.0])
@pytest.mark.parametrize("robot", [BURGER, WAFFLE, AGV, attrs.evolve(BURGER, acceleration=0.1)])
def test_a_robot_brakes_where_its_path_ends_and_not_long_before(robot, yaw):
    """From rest to rest, 1 m takes 1 m / v + v / a; the tolerance is 0.1 m, and samples are up to a tenth slower."""
    session = Dwb().start_fleet((robot,), NOWHERE, PERIOD)
    pose, twist, arrived = np.zeros((1, 3)), np.zeros((1, 2)), None
    most = np.array([robot.acceleration, robot.turn_acceleration]) * PERIOD
    for period in range(400):
        path = np.array([[(min(pose[0, 0], 1.0), 0.0), (1.0, 0.0)]])
        wanted = session.command(attrs.evolve(look(period * PERIOD, pose, twist, path), yaw=np.array([yaw])))
        twist = twist + np.clip(wanted - twist, -most, most)
        pose = driven(pose, twist, PERIOD)
        assert pose[0, 0] < 1.0
        if arrived is None and pose[0, 0] >= 0.9:
            arrived = period * PERIOD
    assert twist[0, 0] == 0
    assert arrived < 1.15 * (1.0 / robot.max_speed + robot.max_speed / robot.acceleration)


@attrs.frozen(kw_only=True)
class Leftward(Critic):
    answer: str = "left"

    def start(self, robot, world):
        assert robot.name == BURGER.name
        return _Leftward(self.answer)


class _Leftward(CriticSession):
    def __init__(self, answer):
        self.answer = answer

    def score(self, trajectories):
        assert trajectories.pose.ndim == 3
        assert len(trajectories.pose) == len(trajectories.twist)
        assert trajectories.path.tolist() == [[0, 0], [1, 0]]
        if self.answer == "left":
            return np.where(trajectories.twist[:, 1] > 0, 0.0, np.inf)
        if self.answer == "short":
            return np.zeros(3)
        return np.full(len(trajectories.twist), {"nothing": np.inf, "nan": np.nan}[self.answer])


def ask(*critics):
    session = Dwb(critics=critics).start_fleet((BURGER,), NOWHERE, PERIOD)
    path = np.array([[(0.0, 0.0), (1.0, 0.0)]])
    return session.command(look(0.0, np.zeros((1, 3)), np.zeros((1, 2)), path))[0], session


def test_critics_in_python_have_their_say():
    plain, _ = ask(GoalDist())
    command, _ = ask(GoalDist(), Leftward(scale=2.0))
    assert abs(plain[1]) < 0.06
    assert command[1] > 0
    assert np.isnan(ask(GoalDist(), Leftward(answer="nothing"))[0]).all()
    assert ask(GoalDist(), Leftward(answer="nothing", scale=0.0))[0].tolist() == plain.tolist()


def test_a_fleet_of_several_robots_has_critics_in_python():
    session = Dwb(critics=(GoalDist(), Leftward())).start_fleet((BURGER, BURGER), NOWHERE, PERIOD)
    path = np.array([[(0.0, 0.0), (1.0, 0.0)]] * 2)
    assert (session.command(look(0.0, np.zeros((2, 3)), np.zeros((2, 2)), path))[:, 1] > 0).all()


@pytest.mark.parametrize("answer", ["short", "nan"])
def test_a_critic_that_returns_no_scores_is_blamed_by_its_name(answer):
    with pytest.raises(BrokenContractError, match="the critic Leftward returned"):
        ask(GoalDist(), Leftward(answer=answer))


def encircled(distance):
    """The session and first command of a robot whose beams all end at a distance."""
    session = Dwb(critics=(BaseObstacle(),), local_costmap=LocalCostmap(footprint_clearing_enabled=False)).start_fleet(
        (BURGER,), NOWHERE, PERIOD
    )
    scan = ScanBatch(stamp=0.0, robot=[0], ranges=np.full((1, 360), distance))
    path = np.array([[(0.0, 0.0), (1.0, 0.0)]])
    return session, session.command(look(0.0, np.zeros((1, 3)), np.zeros((1, 2)), path, (scan,)))[0]


def test_a_robot_without_an_admissible_command_says_why():
    session, command = encircled(0.04)
    assert np.isnan(command).all()
    assert session.failure_reason(0) == "419 × BaseObstacle: Trajectory Hits Obstacle."


def test_a_robot_that_is_too_close_to_everything_around_it_may_turn_only():
    session, command = encircled(0.13)
    assert command[0] == 0
    assert command[1] != 0
    assert session.failure_reason(0).endswith("× BaseObstacle: Trajectory Hits Obstacle.")


def test_a_robot_at_the_end_of_its_path_stands():
    session = Dwb().start_fleet((BURGER,), NOWHERE, PERIOD)
    path = np.array([[(0.0, 0.0), (0.03, 0.0)]])
    assert session.command(look(0.0, np.zeros((1, 3)), np.zeros((1, 2)), path)).tolist() == [[0.0, 0.0]]


def bent(yaw, **options):
    """The first command of a robot at the origin that heads for `yaw`, on a path along x."""
    session = Dwb(**options).start_fleet((BURGER,), NOWHERE, PERIOD)
    path = np.array([[(0.0, 0.0), (2.0, 0.0)]])
    return session.command(look(0.0, np.array([[0.0, 0.0, yaw]]), np.zeros((1, 2)), path))[0]


@pytest.mark.parametrize("yaw", [-3.0, -0.5, 0.5, 2.0])
def test_a_robot_turns_to_a_new_path_before_it_drives_along_it(yaw):
    ahead, turn = bent(yaw)
    assert ahead == 0
    assert np.sign(turn) == -np.sign(yaw)


def test_a_robot_that_heads_along_its_path_drives():
    assert bent(0.3)[0] > 0
    assert bent(0.5, rotate_to_path=0.0)[0] > 0
