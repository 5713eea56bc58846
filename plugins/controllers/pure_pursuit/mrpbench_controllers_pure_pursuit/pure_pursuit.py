"""Regulated pure pursuit for differential drive.

Steers the arc that leads to a point of the path a fixed distance ahead (Coulter, "Implementation of the Pure Pursuit
Path Tracking Algorithm", CMU-RI-TR-92-01, 1992), slows down in tight turns and before the end, and turns on the spot
where the path leads elsewhere (Macenski, Singh, Martín and Ginés, "Regulated Pure Pursuit for Robot Path Tracking",
Autonomous Robots 47, 2023). Options that Nav2's controller has carry its names; the defaults suit grids of 0.35 m.
"""

from collections.abc import Sequence

import attrs
import numpy as np
from attrs.validators import ge, gt, optional

from mrpbench_controllers_pure_pursuit.geometry import carrots, limited, path_lengths, stopping_speed, wrapped
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observations
from mrpbench_core.model.worlds.world import World

_AT_END = 0.02
"""metres before the end at which a robot turns to the final yaw."""
_BACK_TO_END = 0.05
"""metres: a robot pushed farther than this from the end, when no path is left, drives straight to it."""


@attrs.frozen(kw_only=True)
class PurePursuit(Controller):
    """Chases a point on the path a fixed distance ahead."""

    desired_linear_vel: float | None = option(
        None, help="cruising speed; by default the robot's highest", unit="m/s", validator=optional(gt(0))
    )
    lookahead_dist: float = option(
        0.2,
        help="distance of the point that is chased; a shorter distance follows corners more closely",
        unit="m",
        validator=gt(0),
    )
    use_rotate_to_heading: bool = option(True, help="turn on the spot where the path leads far off the heading")
    rotate_to_heading_min_angle: float = option(
        0.785, help="turn on the spot if the heading is off by more than this, radians", validator=gt(0)
    )
    angular_disengage_threshold: float = option(
        0.1, help="turn on the spot until the heading is off by less than this, radians", validator=gt(0)
    )
    rotate_to_heading_angular_vel: float = option(
        1.8, help="turn rate on the spot, within the robot's limit", unit="rad/s", validator=gt(0)
    )
    use_regulated_linear_velocity_scaling: bool = option(True, help="slow down in tight turns")
    regulated_linear_scaling_min_radius: float = option(
        0.2, help="slow down in turns tighter than this radius, in proportion", unit="m", validator=gt(0)
    )
    regulated_linear_scaling_min_speed: float = option(
        0.1, help="lowest speed in tight turns", unit="m/s", validator=ge(0)
    )

    def idle_options(self) -> dict[str, str]:
        """Return the options of behaviours that are switched off."""
        idle: dict[str, str] = {}
        if not self.use_rotate_to_heading:
            turning = ("rotate_to_heading_min_angle", "angular_disengage_threshold", "rotate_to_heading_angular_vel")
            idle |= dict.fromkeys(turning, "use_rotate_to_heading is off")
        if not self.use_regulated_linear_velocity_scaling:
            names = ("regulated_linear_scaling_min_radius", "regulated_linear_scaling_min_speed")
            idle |= dict.fromkeys(names, "use_regulated_linear_velocity_scaling is off")
        return idle

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot; the world does not matter to it."""
        del world
        return FleetOfOne(_Fleet(self, (robot,), period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots at once."""
        del world, seed
        return _Fleet(self, robots, period)


class _Fleet(FleetControllerSession):
    def __init__(self, options: PurePursuit, robots: Sequence[RobotModel], period: float) -> None:
        super().__init__(())
        self._options, self._period = options, period
        fastest = np.array([robot.max_speed for robot in robots])
        self._max_turn_rate = np.array([robot.max_turn_rate for robot in robots])
        self._acceleration = np.array([robot.acceleration for robot in robots])
        self._turn_acceleration = np.array([robot.turn_acceleration for robot in robots])
        self._cruise = np.minimum(options.desired_linear_vel or fastest, fastest)
        self._spin = np.minimum(options.rotate_to_heading_angular_vel, self._max_turn_rate)
        self._braking = self._cruise * period + self._cruise**2 / (2 * self._acceleration)
        self._turning: Bool = np.zeros(len(robots), bool)

    def clear(self, robot: int) -> None:
        """Do nothing: there is no costmap."""

    def is_free(self, robot: int, poses: Float) -> Bool:  # noqa: ARG002 - there is no costmap
        """Tell that every pose is free: there is no costmap."""
        return np.ones(len(poses), bool)

    def reroute(self, observations: Observations, row: int) -> None:
        """Return None: there is no costmap to find a way on."""

    def approach(self, observations: Observations, row: int, tolerance: float) -> None:
        """Return None: there is no costmap to find a way on."""

    def command(self, observations: Observations) -> Float:
        """Return the commands f8[k,2] of all rows."""
        seen, robot = observations, observations.robot
        acceleration, place = self._acceleration[robot], seen.pose[:, :2]
        path, begin = seen.foot, seen.begin
        left = path_lengths(path, seen.points, begin, seen.end, self._braking[robot])
        end = seen.points[seen.end - 1]
        away = np.hypot(end[:, 0] - place[:, 0], end[:, 1] - place[:, 1])
        at_end = left <= _AT_END
        resting = at_end & (away <= _BACK_TO_END)
        pushed = at_end & ~resting & (left == 0)
        if pushed.any():  # away from the end of a path of which nothing is left
            path = np.where(pushed[:, None], place, path)
            begin = np.where(pushed, seen.end - 1, begin)
            left = np.where(pushed, away, left)
        aim = carrots(path, seen.points, begin, seen.end, place, self._options.lookahead_dist)
        offset = aim - place
        distance = np.hypot(offset[:, 0], offset[:, 1])
        there = distance > 0
        error = np.where(there, wrapped(np.arctan2(offset[:, 1], offset[:, 0]) - seen.pose[:, 2]), 0.0)
        turning = self._must_turn(np.abs(error), self._turning[robot])
        self._turning[robot[~resting]] = turning[~resting]
        curvature = np.where(there, 2 * np.sin(error) / np.where(there, distance, 1.0), 0.0)
        stopping = np.minimum(stopping_speed(left, acceleration, self._period), seen.speed)
        wanted = np.minimum(self._regulated(robot, curvature), stopping)
        # Close to the end a robot drives there slowly, or turns to the prescribed yaw.
        any_yaw = np.isnan(seen.yaw)
        turning |= resting & ~any_yaw
        error = np.where(resting, np.where(any_yaw, 0.0, wrapped(seen.yaw - seen.pose[:, 2])), error)
        wanted = np.where(resting, stopping, wanted)
        wanted = limited(np.where(turning, 0.0, wanted), seen.twist[:, 0], acceleration * self._period)
        wanted = np.where(resting & ~any_yaw, 0.0, wanted)
        change = self._turn_acceleration[robot] * self._period
        along_arc = limited(wanted * np.where(resting, 0.0, curvature), seen.twist[:, 1], change)
        along_arc = np.where(resting, 0.0, along_arc)
        return np.column_stack([wanted, np.where(turning, self._turn(robot, error), along_arc)])

    def _must_turn(self, error: Float, turning: Bool) -> Bool:
        """Turn on the spot once the heading is far off, and then until it is nearly right."""
        options = self._options
        if not options.use_rotate_to_heading:
            return np.zeros_like(turning)
        far: Bool = error > np.where(turning, options.angular_disengage_threshold, options.rotate_to_heading_min_angle)
        return far

    def _turn(self, robot: np.ndarray, error: Float) -> Float:
        fastest = stopping_speed(np.abs(error), self._turn_acceleration[robot], self._period)
        turn: Float = np.copysign(np.minimum(self._spin[robot], fastest), error)
        return turn

    def _regulated(self, robot: np.ndarray, curvature: Float) -> Float:
        """Cruising speed, reduced in tight turns."""
        options, bend, speed = self._options, np.abs(curvature), self._cruise[robot]
        wide = np.maximum(bend, 1e-9)
        if options.use_regulated_linear_velocity_scaling:
            slow = speed / np.maximum(wide * options.regulated_linear_scaling_min_radius, 1.0)
            speed = np.minimum(speed, np.maximum(slow, options.regulated_linear_scaling_min_speed))
        regulated: Float = np.minimum(speed, self._max_turn_rate[robot] / wide)
        return regulated
