"""Regulated pure pursuit for differential drive, in C++.

Steers the arc that leads to a point of the path a fixed distance ahead (Coulter, "Implementation of the Pure Pursuit
Path Tracking Algorithm", CMU-RI-TR-92-01, 1992), slows down in tight turns and before the end, and turns on the spot
where the path leads elsewhere (Macenski, Singh, Martín and Ginés, "Regulated Pure Pursuit for Robot Path Tracking",
Autonomous Robots 47, 2023). Options that Nav2's controller has carry its names; the defaults suit grids of 0.35 m.
"""

from collections.abc import Sequence

import attrs
import numpy as np
from attrs.validators import ge, gt, optional
from mrpbench_native.navigation import PurePursuit as NativePurePursuit

from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observations
from mrpbench_core.model.worlds.world import World


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
        fastest = np.array([robot.max_speed for robot in robots])
        turn_rate = np.array([robot.max_turn_rate for robot in robots])
        fleet = np.column_stack(
            [
                np.minimum(options.desired_linear_vel or fastest, fastest),
                np.minimum(options.rotate_to_heading_angular_vel, turn_rate),
                turn_rate,
                [robot.acceleration for robot in robots],
                [robot.turn_acceleration for robot in robots],
            ]
        )
        self._native = NativePurePursuit(options=attrs.asdict(options) | {"period": period}, robots=fleet)

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
        return self._native.command(
            observations.robot,
            observations.pose,
            observations.twist,
            observations.foot,
            observations.points,
            observations.begin,
            observations.end,
            observations.yaw,
            observations.speed,
        )
