"""Each of Nav2's critics against scores computed by hand."""

import math

import numpy as np
import pytest
from mrpbench_controllers_dwb import (
    BaseObstacle,
    Dwb,
    GoalAlign,
    GoalDist,
    LocalCostmap,
    ObstacleFootprint,
    Oscillation,
    PathAlign,
    PathDist,
    PreferForward,
    RotateToGoal,
    Twirling,
)

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.observation import Observation, Observations, ScanBatch
from mrpbench_core.model.worlds.world import World

BURGER = load_robot("turtlebot3_burger")
NOWHERE = World(name="w", levels=())
POSE = (0.025, 0.025, 0.0)
"""The middle of a cell."""
PATH = ((0.025, 0.025), (0.625, 0.025))


class Judged:
    """The scores of the trajectories of one robot by critics."""

    def __init__(self, critics, poses=(POSE,), twist=(0.0, 0.0), path=PATH, yaw=math.nan, scan=None, **options):
        costmap = options.pop("costmap", LocalCostmap(robot_radius=0.1))
        dwb = Dwb(
            critics=tuple(critics),
            short_circuit_trajectory_evaluation=False,
            local_costmap=costmap,
            beyond_end=0.0,
            **options,
        )
        session = dwb.start_fleet((BURGER,), NOWHERE, 0.05)
        for period, pose in enumerate(poses):
            now = period * 0.2
            batch = None if scan is None else ScanBatch(stamp=now, robot=[0], ranges=[scan])
            seen = Observation(
                now=now, pose=np.array(pose), twist=np.array(twist), path=np.array(path), yaw=yaw, scan=batch
            )
            self.command = session.command(Observations.alone(seen))[0]
        said = session.explain(0)
        self.twist, self.pose, self.reason = said["twist"], said["pose"], said["reason"]
        self.raw, self.total = said["score"], said["total"]

    def of(self, speed, turn):
        """The index of the sample nearest to a velocity."""
        return int(np.hypot(self.twist[:, 0] - speed, self.twist[:, 1] - turn).argmin())


def cell(value):
    return math.floor(value / 0.05 + 1e-9)


def test_path_dist_counts_cells_to_the_path_along_rows_and_columns():
    judged = Judged([PathDist(scale=32.0)])
    for index in range(0, len(judged.twist), 7):
        x, y, _ = judged.pose[index, -1]
        beyond = max(0, cell(x) - 12) + max(0, -cell(x))
        assert judged.raw[0, index] == abs(cell(y)) + beyond
        assert judged.total[index] == pytest.approx(judged.raw[0, index] * 0.05 * 0.5 * 32)


def test_goal_dist_counts_cells_to_the_end_of_the_path():
    judged = Judged([GoalDist()])
    for index in range(0, len(judged.twist), 7):
        x, y, _ = judged.pose[index, -1]
        assert judged.raw[0, index] == abs(cell(x) - 12) + abs(cell(y))


def test_the_goal_is_where_the_path_leaves_the_costmap():
    judged = Judged([GoalDist()], path=((0.025, 0.025), (5.025, 0.025)))
    still = judged.of(0.0, 0.5)
    assert judged.raw[0, still] == 20  # of points every 5 cm, those up to prune_distance = 1 m away


def test_those_that_align_look_ahead_of_the_robot():
    judged = Judged([PathAlign(forward_point_distance=0.1), GoalAlign(forward_point_distance=0.1)])
    for index in range(0, len(judged.twist), 7):
        x, y, yaw = judged.pose[index, -1]
        x, y = x + 0.1 * math.cos(yaw), y + 0.1 * math.sin(yaw)
        assert judged.raw[0, index] == abs(cell(y)) + max(0, cell(x) - 12) + max(0, -cell(x))
        assert judged.raw[1, index] == abs(cell(x) - 14) + abs(cell(y))


def test_path_align_is_silent_near_the_goal():
    judged = Judged([PathAlign(forward_point_distance=0.1)], path=((0.025, 0.025), (0.115, 0.025)))
    assert not judged.total.any()


def test_aggregation_sums_or_multiplies_the_scores_of_all_poses():
    last, total, product = (
        Judged([GoalDist(aggregation_type=kind)], include_last_point=False) for kind in ("last", "sum", "product")
    )
    index = last.of(0.0, 1.0)  # turns on the spot: all its poses are alike
    poses = math.ceil(1.7 / 0.025) + 1
    assert last.raw[0, index] == 12
    assert total.raw[0, index] == 12 * poses
    assert product.raw[0, index] == pytest.approx(12.0**poses)


def test_rotate_to_goal_says_nothing_far_from_the_goal():
    judged = Judged([RotateToGoal()], yaw=1.0)
    assert not judged.raw.any()
    assert set(judged.reason) == {""}


def test_rotate_to_goal_only_turns_at_the_goal_once_the_robot_is_slow():
    near = ((0.025, 0.025), (0.085, 0.025))
    judged = Judged([RotateToGoal()], path=near, yaw=1.0)
    for index, (speed, _) in enumerate(judged.twist):
        assert (judged.reason[index] != "") == (speed != 0)
    left = judged.of(0.0, 0.4737)
    assert judged.raw[0, left] == pytest.approx(abs(judged.pose[left, -1, 2] - 1.0))
    assert judged.command[0] == 0
    assert judged.command[1] > 0


def test_rotate_to_goal_slows_down_first():
    near = ((0.025, 0.025), (0.085, 0.025))
    judged = Judged([RotateToGoal()], path=near, yaw=1.0, twist=(0.2, 0.0), trans_stopped_velocity=0.05)
    faster, slower = judged.of(0.22, 0.0), judged.of(0.1, 0.0)
    assert judged.reason[faster] == "RotateToGoal: Not slowing down near goal."
    speed = judged.twist[slower, 0]
    assert judged.raw[0, slower] == pytest.approx(speed**2 * 5 + abs(judged.pose[slower, -1, 2] - 1.0))


def test_rotate_to_goal_begins_no_farther_away_than_the_navigator_accepts():
    judged = Judged([RotateToGoal()], path=((0.025, 0.025), (0.175, 0.025)), yaw=1.0)
    assert set(judged.reason) == {""}  # 0.15 m away: within Nav2's 0.25 m, but not within 0.1 m


def test_a_robot_that_turned_back_must_go_on_that_way_for_a_while():
    critics = [Oscillation(), GoalDist(), GoalAlign(forward_point_distance=0.1)]
    options = {
        "short_circuit_trajectory_evaluation": False,
        "beyond_end": 0.0,
        "rotate_to_path": 0.0,
        "max_vel_x": 0.04,
    }
    session = Dwb(critics=tuple(critics), **options).start_fleet((BURGER,), NOWHERE, 0.05)

    def look(now, yaw):
        """One command with the same goal behind the robot."""
        path = np.array([(0.025, 0.025), (-0.575, 0.025)])
        seen = Observation(now=now, pose=np.array([0.025, 0.025, yaw]), twist=np.zeros(2), path=path)
        return session.command(Observations.alone(seen))[0], session.explain(0)

    (_, left), _ = look(0.0, 2.0)
    (_, right), _ = look(0.05, -2.0)
    assert left > 0 > right
    _, said = look(0.10, -2.0)
    forbidden = [bool(reason) for reason in said["reason"]]
    assert forbidden == (said["twist"][:, 1] > 0).tolist()
    assert set(said["reason"]) == {"", "Oscillation: Trajectory is oscillating."}
    look(0.15, -2.3)  # turned by more than 0.2 since
    assert set(look(0.20, -2.3)[1]["reason"]) == {""}


def wall_ahead(distance):
    """A wall across the way, seen over a quarter of the circle."""
    angle = np.arange(360) * 2 * np.pi / 360
    ranges = np.full(360, np.inf)
    ahead = np.cos(angle) > 0.71
    ranges[ahead] = distance / np.cos(angle[ahead])
    return ranges


def test_base_obstacle_reads_the_cost_under_the_centre():
    judged = Judged([BaseObstacle()], scan=wall_ahead(0.6), poses=((0.025, 0.025, 0.0),))
    inscribed = 0.1078
    column = cell(0.025 - 0.032 + 0.6)  # the lidar sits 3.2 cm behind the centre
    free = 0
    for speed in np.unique(judged.twist[:, 0])[1:]:
        index = judged.of(speed, 0.0)
        distance = (column - cell(judged.pose[index, -1, 0])) * 0.05
        if distance <= inscribed:
            assert judged.reason[index] == "BaseObstacle: Trajectory Hits Obstacle."
            continue
        expected = math.floor(252 * math.exp(-3.0 * (distance - 0.10788))) if distance <= 0.55 else 0
        assert judged.raw[0, index] == pytest.approx(expected, abs=1)
        free += 1
    assert free > 10


def test_a_trajectory_that_hits_something_on_the_way_is_dropped():
    judged = Judged([BaseObstacle()], scan=wall_ahead(0.25))
    assert judged.reason[judged.of(0.22, 0.0)] == "BaseObstacle: Trajectory Hits Obstacle."
    assert judged.command[0] <= 0.06


def test_obstacle_footprint_looks_along_the_outline():
    square = ((0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2), (0.2, -0.2))
    plain = LocalCostmap(footprint=square, plugins=("obstacle_layer",), footprint_padding=0.0)
    judged = Judged([ObstacleFootprint(), BaseObstacle()], scan=wall_ahead(0.6), costmap=plain)
    column = cell(0.025 - 0.032 + 0.6)
    for speed in np.unique(judged.twist[:, 0])[1:]:
        index = judged.of(speed, 0.0)
        hits = cell(judged.pose[index, -1, 0] + 0.2) == column
        beyond = cell(judged.pose[index, -1, 0] + 0.2) > column
        if not beyond:  # an outline that has passed the thin wall touches it elsewhere
            assert (judged.reason[index] == "ObstacleFootprint: Trajectory Hits Obstacle.") == hits


def test_prefer_forward_dislikes_creeping_and_turning():
    judged = Judged([PreferForward()])
    assert judged.raw[0, judged.of(0.05, 0.0)] == 1.0
    turning = judged.of(0.22, 0.4737)
    assert judged.raw[0, turning] == pytest.approx(10 * judged.twist[turning, 1])
    back = Judged([PreferForward()], min_vel_x=-0.1)
    assert back.raw[0, back.of(-0.1, 0.0)] == 1.0


def test_twirling_dislikes_turning():
    judged = Judged([Twirling(scale=2.0)])
    assert np.allclose(judged.raw[0], np.abs(judged.twist[:, 1]))
    assert np.allclose(judged.total, 2 * judged.raw[0])


def test_a_scale_of_zero_switches_a_critic_off_with_its_faults():
    judged = Judged([BaseObstacle(scale=0.0), Twirling()], scan=wall_ahead(0.25))
    assert set(judged.reason) == {""}


def test_the_first_of_equal_trajectories_is_taken():
    judged = Judged([Twirling(), PreferForward(scale=0.0)])
    assert judged.command.tolist() == pytest.approx([0.22 / 19, 0.0])
