"""The rotation shim for a fleet: robots that turn get its commands, the others those of the primary controller."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api import Evaluation, FleetControllerSession
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observations

_CHECKS = 10
"""Poses of a turn that are checked for collisions."""


@attrs.frozen(kw_only=True)
class Turning:
    """When and how robots turn; see the options of `RotationShim`."""

    forward_sampling_distance: float
    angular_dist_threshold: float
    angular_disengage_threshold: float
    rotate_to_heading_angular_vel: float
    max_angular_accel: float
    simulate_ahead_time: float
    rotate_to_goal_heading: bool
    closed_loop: bool


class RotationShimSession(FleetControllerSession):
    """Controls all robots at once.

    Args:
        primary: controls the robots that do not turn.
        turning: when and how robots turn.
        robots: the fleet, whose limits hold.
        period: control period, simulated seconds.
    """

    def __init__(
        self, primary: FleetControllerSession, turning: Turning, robots: Sequence[RobotModel], period: float
    ) -> None:
        super().__init__(())
        self._primary, self._turning, self._period = primary, turning, period
        self._spin = np.array([min(turning.rotate_to_heading_angular_vel, robot.max_turn_rate) for robot in robots])
        self._accel = np.array([min(turning.max_angular_accel, robot.turn_acceleration) for robot in robots])
        self._goal: Float = np.full((len(robots), 2), np.inf)
        """f8[n,2]: where the path of each robot ended in the last period."""
        self._turns: Bool = np.zeros(len(robots), bool)
        self._turns_now: Bool = np.zeros(len(robots), bool)
        """bool[n]: whether each robot turns in this period, to its path or to the yaw at the end."""
        self._last: Float = np.zeros(len(robots))
        """f8[n]: the last turn rate commanded."""
        self._blocked: Bool = np.zeros(len(robots), bool)

    def command(self, observations: Observations) -> Float:
        """The commands f8[k,2] of all rows, NaN where there is no room to turn, or none of the primary controller."""
        robot = observations.robot
        end = observations.points[observations.end - 1]
        is_new = (end != self._goal[robot]).any(axis=1)
        self._goal[robot] = end
        angle: Float = np.zeros(len(robot))
        for row in (is_new | self._turns[robot]).nonzero()[0].tolist():
            angle[row] = self._angle_to_path(observations, row)
        threshold = np.where(is_new, self._turning.angular_dist_threshold, self._turning.angular_disengage_threshold)
        turns = (is_new | self._turns[robot]) & (np.abs(angle) > threshold)
        self._turns[robot] = turns
        if self._turning.rotate_to_goal_heading:
            away = np.hypot(*(end - observations.pose[:, :2]).T)
            at_end = (away <= observations.tolerance) & ~np.isnan(observations.yaw)
            angle = np.where(at_end, _wrapped(observations.yaw - observations.pose[:, 2]), angle)
            turns = turns | at_end
        self._turns_now[robot] = turns
        twist = np.empty((len(robot), 2))
        others = (~turns).nonzero()[0]
        twist[others] = self._primary.command(_rows(observations, others))
        self._blocked[robot] = False
        for row in turns.nonzero()[0].tolist():
            twist[row] = self._turn(observations, row, float(angle[row]))
        self._last[robot] = np.nan_to_num(twist[:, 1])
        return twist

    def _angle_to_path(self, observations: Observations, row: int) -> float:
        """Angle from the heading of a robot to the point of its path that is the sampling distance away, radians."""
        path = observations.path(row)
        legs = np.hypot(*np.diff(path, axis=0).T)
        along = np.append(0.0, np.cumsum(legs))
        distance = self._turning.forward_sampling_distance
        aim = np.array([np.interp(distance, along, path[:, axis]) for axis in (0, 1)])
        x, y = (aim - observations.pose[row, :2]).tolist()
        if np.hypot(x, y) <= observations.tolerance:  # a robot that has nearly arrived need not turn
            return 0.0
        return float(_wrapped(np.arctan2(y, x) - observations.pose[row, 2]))

    def _turn(self, observations: Observations, row: int, angle: float) -> tuple[float, float]:
        """The command of a robot that turns, so fast that it can stop at the wanted heading."""
        robot = int(observations.robot[row])
        accel = float(self._accel[robot])
        now = float(observations.twist[row, 1] if self._turning.closed_loop else self._last[robot])
        change = accel * self._period
        rate = float(np.clip(np.copysign(self._spin[robot], angle), now - change, now + change))
        if rate * angle > 0:
            rate = float(np.copysign(min(abs(rate), np.sqrt(2 * accel * abs(angle))), rate))
        share = min(1.0, abs(rate) * self._turning.simulate_ahead_time / max(abs(angle), 1e-9))
        poses = np.tile(observations.pose[row], (_CHECKS, 1))
        poses[:, 2] += angle * share * np.linspace(0.0, 1.0, _CHECKS)
        if not self._primary.is_free(robot, poses).all():
            self._blocked[robot] = True
            return float("nan"), float("nan")
        return 0.0, rate

    def clear(self, robot: int) -> None:
        """Forget what one robot's sensors have marked."""
        self._primary.clear(robot)

    def is_free(self, robot: int, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] one robot fits."""
        return self._primary.is_free(robot, poses)

    def reroute(self, observations: Observations, row: int) -> Float | None:
        """Find a way around what blocks the path of one row."""
        return self._primary.reroute(observations, row)

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:
        """Find a way to the free place that is nearest to the end of the path of one row."""
        return self._primary.approach(observations, row, tolerance)

    def evaluation(self, robot: int) -> Evaluation | None:
        """Return what the primary controller weighed, None while the robot turns."""
        return None if self._turns_now[robot] else self._primary.evaluation(robot)

    def failure_reason(self, robot: int) -> str:
        """Return why a robot had no admissible command."""
        return "there is no room to turn" if self._blocked[robot] else self._primary.failure_reason(robot)


def _wrapped(angle: Float | float) -> Float:
    wrapped: Float = np.remainder(np.asarray(angle) + np.pi, 2 * np.pi) - np.pi
    return wrapped


def _rows(observations: Observations, rows: np.ndarray) -> Observations:
    """Some rows of observations, with the scans of all robots."""
    if len(rows) == len(observations.robot):
        return observations
    names = ("robot", "pose", "twist", "foot", "begin", "end", "yaw", "speed")
    return attrs.evolve(observations, **{name: getattr(observations, name)[rows] for name in names})
