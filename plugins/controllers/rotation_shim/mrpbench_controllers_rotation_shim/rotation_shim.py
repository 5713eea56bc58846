"""The recipe: the rotation shim with the names and defaults of Nav2 (lyrical 1.5), around any controller."""

from collections.abc import Sequence
from pathlib import Path

import attrs
from attrs.validators import gt

from mrpbench_controllers_rotation_shim.session import RotationShimSession, Turning
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.api.nav2 import parameter, settle
from mrpbench_core.files.nav2 import Nav2Block, nav2_block
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class RotationShim(Controller):
    """Turns on the spot to a new path that leads far off the heading, then leaves the robot to another controller."""

    primary_controller: Controller = option(help="the controller that drives the robot once it heads along its path")
    nav2: Path | None = option(
        None,
        help="a Nav2 parameter file, whose block FollowPath has the parameters of the shim; options given here win",
    )
    forward_sampling_distance: float | None = parameter(
        0.5, help="distance along the path of the point to which the robot turns", unit="m", validator=gt(0)
    )
    angular_dist_threshold: float | None = parameter(
        0.785, help="turn if the heading is off by more than this, radians", validator=gt(0)
    )
    angular_disengage_threshold: float | None = parameter(
        0.3925, help="turn until the heading is off by less than this, radians", validator=gt(0)
    )
    rotate_to_heading_angular_vel: float | None = parameter(
        1.8, help="turn rate, within the robot's limit", unit="rad/s", validator=gt(0)
    )
    max_angular_accel: float | None = parameter(
        3.2, help="acceleration of the turn, within the robot's limit, rad/s^2", validator=gt(0)
    )
    simulate_ahead_time: float | None = parameter(
        1.0, help="look this far ahead for collisions of the turning robot", unit="s", validator=gt(0)
    )
    rotate_to_goal_heading: bool | None = parameter(False, help="turn to the yaw that is prescribed at the end, too")
    closed_loop: bool | None = parameter(True, help="accelerate from the measured turn rate, not from the last command")

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 block, so that errors in it are found before anything runs."""
        settle(self, self._block())

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call."""
        primary = self.primary_controller.start_fleet(robots, world, period, seed)
        return RotationShimSession(primary, Turning(**settle(self, self._block())), robots, period)

    @property
    def needs_lidar(self) -> bool:
        """True if the other controller works by scans."""
        return self.primary_controller.needs_lidar

    def idle_options(self) -> dict[str, str]:
        """Return the idle options of the other controller."""
        return {f"primary_controller.{name}": why for name, why in self.primary_controller.idle_options().items()}

    def _block(self) -> Nav2Block | None:
        return None if self.nav2 is None else nav2_block(self.nav2, "controller_server", "FollowPath")
