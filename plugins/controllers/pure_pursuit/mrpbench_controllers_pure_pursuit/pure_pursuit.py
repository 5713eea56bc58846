"""Regulated pure pursuit for differential drive.

Steers the arc that leads to a point of the path a fixed distance ahead (Coulter, "Implementation of the Pure Pursuit
Path Tracking Algorithm", CMU-RI-TR-92-01, 1992), slows down in tight turns and before the end, and turns on the spot
where the path leads elsewhere (Macenski, Singh, Martín and Ginés, "Regulated Pure Pursuit for Robot Path Tracking",
Autonomous Robots 47, 2023). Options that Nav2's controller has carry its names; the defaults suit grids of 0.35 m.
"""

import math

import attrs
from attrs.validators import ge, gt, optional

from mrpbench_controllers_pure_pursuit.geometry import carrot, path_length, stopping_speed
from mrpbench_core.api import Controller, ControllerSession, option
from mrpbench_core.model.execution import Observation
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.world import World

_AT_END = 0.02
"""metres before the end at which the final yaw is taken."""
_BACK_TO_END = 0.05
"""metres: a robot pushed farther than this from the end, when no path is left, drives straight to it."""


@attrs.frozen(kw_only=True)
class PurePursuit(Controller):
    """Chases a point on the path a fixed distance ahead."""

    desired_linear_vel: float | None = option(
        None, help="cruising speed; by default the robot's highest", unit="m/s", validator=optional(gt(0))
    )
    lookahead_dist: float = option(
        0.2, help="distance of the point that is chased; shorter follows corners closer", unit="m", validator=gt(0)
    )
    use_rotate_to_heading: bool = option(True, help="turn on the spot when the path leads far from straight ahead")
    rotate_to_heading_min_angle: float = option(
        0.785, help="turn on the spot when the heading is off by more than this, radians", validator=gt(0)
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
    regulated_linear_scaling_min_speed: float = option(0.1, help="but not below this", unit="m/s", validator=ge(0))

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot; the world does not matter to it."""
        del world
        return _Session(self, robot, period)


class _Session(ControllerSession):
    def __init__(self, options: PurePursuit, robot: RobotModel, period: float) -> None:
        self._options, self._robot, self._period = options, robot, period
        self._cruise = min(options.desired_linear_vel or robot.max_speed, robot.max_speed)
        self._spin = min(options.rotate_to_heading_angular_vel, robot.max_turn_rate)
        self._braking = self._cruise * period + self._cruise**2 / (2 * robot.acceleration)
        self._turning = False

    def command(self, observation: Observation) -> tuple[float, float]:
        x, y, yaw = observation.pose.tolist()
        speed, turn_rate = observation.twist.tolist()
        path = observation.path.tolist()
        left = path_length(path, self._braking)
        if left <= _AT_END:
            end_x, end_y = path[-1]
            away = math.hypot(end_x - x, end_y - y)
            if away <= _BACK_TO_END:
                return self._near_end(observation, yaw, left, speed)
            if left == 0:
                path, left = [(x, y), path[-1]], away
        aim_x, aim_y = carrot(path, x, y, self._options.lookahead_dist)
        distance = math.hypot(aim_x - x, aim_y - y)
        error = math.remainder(math.atan2(aim_y - y, aim_x - x) - yaw, math.tau) if distance else 0.0
        if self._must_turn(abs(error)):
            return self._limited(0.0, speed), self._turn(error)
        curvature = 2 * math.sin(error) / distance if distance else 0.0
        wanted = min(self._regulated(curvature), observation.speed)
        wanted = min(wanted, stopping_speed(left, self._robot.acceleration, self._period))
        wanted = self._limited(wanted, speed)
        return wanted, self._limited_turn(wanted * curvature, turn_rate)

    def _near_end(self, observation: Observation, yaw: float, left: float, speed: float) -> tuple[float, float]:
        """Creep to the very end, then take the yaw that is wanted there."""
        creep = min(stopping_speed(left, self._robot.acceleration, self._period), observation.speed)
        if math.isnan(observation.yaw):
            return self._limited(creep, speed), 0.0
        return 0.0, self._turn(math.remainder(observation.yaw - yaw, math.tau))

    def _must_turn(self, error: float) -> bool:
        """Turn on the spot once the heading is far off, and then until it is nearly right."""
        options = self._options
        threshold = options.angular_disengage_threshold if self._turning else options.rotate_to_heading_min_angle
        self._turning = options.use_rotate_to_heading and error > threshold
        return self._turning

    def _turn(self, error: float) -> float:
        fastest = stopping_speed(abs(error), self._robot.turn_acceleration, self._period)
        return math.copysign(min(self._spin, fastest), error)

    def _regulated(self, curvature: float) -> float:
        """Cruising speed, reduced in tight turns."""
        options, bend = self._options, abs(curvature)
        speed = self._cruise
        if options.use_regulated_linear_velocity_scaling and bend * options.regulated_linear_scaling_min_radius > 1:
            slow = speed / (bend * options.regulated_linear_scaling_min_radius)
            speed = min(speed, max(slow, options.regulated_linear_scaling_min_speed))
        return min(speed, self._robot.max_turn_rate / bend) if bend > 0 else speed

    def _limited(self, wanted: float, speed: float) -> float:
        """`wanted` as far as the acceleration allows within one period."""
        change = self._robot.acceleration * self._period
        return min(max(wanted, speed - change), speed + change)

    def _limited_turn(self, wanted: float, turn_rate: float) -> float:
        change = self._robot.turn_acceleration * self._period
        return min(max(wanted, turn_rate - change), turn_rate + change)
