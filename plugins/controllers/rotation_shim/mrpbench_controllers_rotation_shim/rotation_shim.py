"""The controller `rotation_shim` with the names and defaults of Nav2 (lyrical 1.5), around any controller."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import attrs
from attrs.validators import gt
from mrpbench_controllers_local.controller_block import NOT_HERE, SHIM, controller_block

from mrpbench_controllers_rotation_shim.session import RotationShimSession, Turning
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.api.nav2 import controller_server, parameter, resolve_options
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class RotationShim(Controller):
    """Turns on the spot to a new path that leads far off the heading, then leaves the robot to another controller."""

    primary_controller: Controller = option(help="the controller that drives the robot once it heads along its path")
    nav2: Path | None = option(
        None,
        help="a Nav2 parameter file, whose controller_server has a block of the shim; options given here win",
    )
    namespace: str | None = option(None, help="namespace of the robot in the Nav2 file, where namespaces differ in it")
    controller_id: str | None = option(None, help="id of the shim in the Nav2 file, where it has several")
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
        self.settled()

    def settled(self) -> dict[str, Any]:
        """Return the values of the options of Nav2.

        Raises:
            InputError: the Nav2 file has no shim, or a value that is not supported.
        """
        return resolve_options(self) if self.nav2 is None else self._read(self.nav2)[0]

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call."""
        primary = self.primary_controller.start_fleet(robots, world, period, seed)
        return RotationShimSession(primary, Turning(**self.settled()), robots, period)

    @property
    def needs_lidar(self) -> bool:
        """True if the other controller works by scans."""
        return self.primary_controller.needs_lidar

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle, and the idle options of the other controller."""
        inner = {f"primary_controller.{name}": why for name, why in self.primary_controller.idle_options().items()}
        return inner if self.nav2 else inner | dict.fromkeys(("namespace", "controller_id"), "there is no Nav2 file")

    def notes(self) -> tuple[str, ...]:
        """Return what the Nav2 file says without effect here, and the notes of the other controller."""
        outer = () if self.nav2 is None else self._read(self.nav2)[1]
        inner = self.primary_controller.notes()
        return (*outer, *(note for note in inner if self.nav2 is None or NOT_HERE not in note))

    def _read(self, nav2: Path) -> tuple[dict[str, Any], tuple[str, ...]]:
        """Return what the Nav2 file says, and notes on what it says without effect."""
        file = Nav2File.load(nav2)

        def read(namespace: str) -> tuple[dict[str, Any], tuple[str, ...]]:
            block = controller_block(controller_server(file, namespace), SHIM, self.controller_id)
            unread = ", ".join(name for name in _NOT_USED if name in block)
            return resolve_options(self, block), (f"{nav2}: {block.title}: not used here: {unread}",) if unread else ()

        return file.read("controller_server", self.namespace, read)


_NOT_USED = ("rotate_to_heading_once", "use_path_orientations", "max_cost_threshold")
"""Parameters of Nav2's shim without effect here. The other parameters of its block are for the other controller, which
also refuses those that are unknown."""
