"""The base of recipes of native controllers: Nav2 parameter files, the costmap, and one call for the whole fleet."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import attrs
import numpy as np
from mrpbench_native.local import controller_options, robot_options

from mrpbench_controllers_local.costmap import LocalCostmap
from mrpbench_controllers_local.critics import Critic, NativeCritic
from mrpbench_controllers_local.settings import RobotSettings, lidar_values
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, between, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import settle
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block, nav2_block
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World

_FURTHER = robot_options("further")


@attrs.frozen(kw_only=True, slots=False)
@described(_FURTHER)
class LocalController(Controller):
    """A controller that runs in C++, with a rolling costmap around each robot."""

    native: ClassVar[str]
    """Its name in `mrpbench_native.local`."""
    nav2_plugin: ClassVar[str]
    """Its name in Nav2 parameter files."""
    ignored: ClassVar[tuple[str, ...]] = ()
    """Parameters of Nav2 without effect here: of topics, sideways motion and transforms."""
    renamed: ClassVar[Mapping[str, str]] = {}
    """Names of options in Nav2 parameter files, where these or those of older releases differ."""

    nav2: Path | None = option(
        None, help="a Nav2 parameter file: its blocks FollowPath and local_costmap; options given here win"
    )
    FollowPath: Mapping[str, Any] = attrs.field(
        factory=dict,
        hash=False,
        metadata={"help": "a block FollowPath of a Nav2 parameter file, pasted as it stands", "unit": None},
    )
    local_costmap: LocalCostmap | None = option(None, help="costmap around each robot (default: as in Nav2)")
    threads: int = option(
        1, help="threads that share the robots; results do not depend on their number", validator=between(1, 1024)
    )

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 blocks, so that errors in them are found before anything runs."""
        if self.FollowPath and self.nav2 is not None:
            raise InputError(f"controller: {self.native} takes a Nav2 file or a block FollowPath, not both")
        self.settings(SOME_ROBOT, 0.05)

    @abstractmethod
    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values of the options of Nav2, within the limits of a robot, and those that follow from it."""

    def settled(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return the values of the options of Nav2, before the limits of a robot.

        Raises:
            InputError: a value in the block is not supported.
        """
        if block is not None:
            block.rename(self.renamed)
        values = settle(self, block)
        if block is not None:
            key, plugin = "plugin", block.take("plugin", str, self.nav2_plugin)
            if plugin == _SHIM:  # the parameters of the controller in the shim are in the same block
                key, plugin = "primary_controller", block.take("primary_controller", str, self.nav2_plugin)
                block.ignore(*_OF_SHIM)
            if plugin != self.nav2_plugin:
                raise block.error(f"is not {self.nav2_plugin}", key)
            block.ignore(*self.ignored)
        return values

    def chosen_critics(self, block: Nav2Block | None) -> tuple[Critic, ...]:
        """Return the critics, and refuse what is left unread in the block."""
        if block is not None:
            block.refuse_unknown()
        return ()

    def critic_parameters(self, critic: NativeCritic) -> dict[str, Any]:
        """Return the options of a critic for the native part."""
        return critic.parameters

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call.

        Raises:
            InputError: options contradict each other, or the costmap has too many cells.
        """
        from mrpbench_controllers_local.session import LocalSession

        settings = [(robot, self.settings(robot, period)) for robot in robots]
        try:
            return LocalSession(self.native, settings, world, self.threads, self.critic_parameters, seed)
        except ValueError as error:
            raise InputError(f"controller: {self.native}: {error}", file=self.nav2) from None

    def settings(self, robot: RobotModel, period: float) -> RobotSettings:
        """Return the settings of one robot for the native part.

        Raises:
            InputError: the Nav2 file has a value that is not supported.
        """
        follow, local = self.blocks()
        values = self.settled(follow)
        critics = self.chosen_critics(follow)
        values = self.limits(values, robot, period)
        costmap, footprint = (self.local_costmap or LocalCostmap()).settings(robot, local)
        further = (*_FURTHER, *controller_options(self.native, further=True))
        values |= costmap | {row.name: getattr(self, row.name) for row in further}
        return RobotSettings(values | lidar_values(robot), footprint, critics)

    @property
    def needs_lidar(self) -> bool:
        """True if the costmap has a layer that beams mark."""
        return bool(self.settings(SOME_ROBOT, 0.05).values["obstacle_layer"])

    def blocks(self) -> tuple[Nav2Block | None, Nav2Block | None]:
        """Return the blocks FollowPath and local_costmap, None where there is none."""
        if self.nav2 is None:
            return (Nav2Block("FollowPath", self.FollowPath) if self.FollowPath else None), None
        follow = nav2_block(self.nav2, "controller_server", "FollowPath")
        local = nav2_block(self.nav2, "local_costmap")
        if follow is None and local is None:
            raise InputError("has neither FollowPath of controller_server nor local_costmap", file=self.nav2)
        return follow, local


def limited(value: float | None, limit: float) -> float:
    """Return a value within what the robot can do, which is also the default."""
    return limit if value is None else min(value, limit)


_SHIM = "nav2_rotation_shim_controller::RotationShimController"
_OF_SHIM = (
    *("forward_sampling_distance", "angular_dist_threshold", "angular_disengage_threshold", "max_angular_accel"),
    *("rotate_to_heading_angular_vel", "simulate_ahead_time", "rotate_to_goal_heading", "rotate_to_heading_once"),
    *("closed_loop", "use_path_orientations"),
)
"""Parameters of Nav2's rotation shim, which the plugin `rotation_shim` reads."""
SOME_ROBOT = RobotModel(
    name="any", footprint=np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]), max_speed=1.0, max_turn_rate=1.0
)
