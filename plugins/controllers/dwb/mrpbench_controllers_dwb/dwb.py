"""The recipe: DWB with the names and defaults of Nav2 (galactic, humble), limits and footprint from the robot.

Nav2: Macenski et al., "The Marathon 2: A Navigation System", IROS 2020. DWB descends from the dynamic window approach
(Fox, Burgard and Thrun, IEEE Robotics & Automation Magazine 4, 1997).
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from attrs.validators import ge
from mrpbench_native.local import critic_options, robot_options
from mrpbench_native.options import Option

from mrpbench_controllers_dwb.costmap import LocalCostmap
from mrpbench_controllers_dwb.critic import Critic
from mrpbench_controllers_dwb.nav2_critics import DEFAULT, NATIVE, OF_CONTROLLER, RotateToGoal
from mrpbench_controllers_dwb.settings import RobotSettings
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, settle
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block, nav2_block
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World

_OF_ROBOTS = ("max_vel_x", "max_speed_xy", "acc_lim_x", "acc_lim_theta", "decel_lim_x", "decel_lim_theta")
"""Parameters whose defaults follow from the robot."""
_OF_GOALS = tuple(row for row in critic_options("RotateToGoal") if row.name in OF_CONTROLLER)
_FURTHER = robot_options("dwb_further")
"""Options that Nav2 does not have."""


def _declare(row: Option) -> tuple[Any, Any]:
    return as_parameter(row, unset=row.name in _OF_ROBOTS)


@attrs.frozen(kw_only=True)
@described([*robot_options("dwb"), *_OF_GOALS], _declare)
@described(_FURTHER)
class Dwb(Controller):
    """Samples velocities, simulates each, and takes the one with the best score of its critics."""

    nav2: Path | None = option(
        None, help="a Nav2 parameter file: its blocks FollowPath and local_costmap; options given here win"
    )
    FollowPath: Mapping[str, Any] = attrs.field(
        factory=dict,
        hash=False,
        metadata={"help": "a block FollowPath of a Nav2 parameter file, pasted as it stands", "unit": None},
    )
    critics: tuple[Critic, ...] | None = option(
        None,
        help="critics that score trajectories, in order; default, with scales: "
        + ", ".join(f"{type(critic).__name__} {critic.scale:g}" for critic in DEFAULT),
    )
    extra_critics: tuple[Critic, ...] = option((), help="critics in addition to those of `critics` or of the Nav2 file")
    local_costmap: LocalCostmap | None = option(None, help="costmap around each robot (default: as in Nav2)")
    threads: int = option(
        1, help="threads that share the robots; results do not depend on their number", validator=ge(1)
    )

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 blocks, so that errors in them are found before anything runs."""
        if self.FollowPath and self.nav2 is not None:
            raise InputError("controller: dwb takes a Nav2 file or a block FollowPath, not both")
        self.settings(_SOME_ROBOT, 0.05)

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(self, robots: Sequence[RobotModel], world: World, period: float) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call.

        Raises:
            InputError: options contradict each other, or the costmap has too many cells.
        """
        from mrpbench_controllers_dwb.session import DwbSession

        settings = [(robot, self.settings(robot, period)) for robot in robots]
        try:
            return DwbSession(settings, self.goal_options(), world, self.threads)
        except ValueError as error:
            raise InputError(f"controller: dwb: {error}", file=self.nav2) from None

    def settings(self, robot: RobotModel, period: float) -> RobotSettings:
        """Return the settings of one robot for the native part.

        Raises:
            InputError: the Nav2 file has a value that is not supported.
        """
        follow, local = self._blocks()
        values = self._values(follow)
        critics = self._critics(follow)
        costmap, footprint = (self.local_costmap or LocalCostmap()).settings(robot, local)
        for row in _OF_GOALS:
            del values[row.name]
        _within(values, "max_vel_x", robot.max_speed)
        _within(values, "max_vel_theta", robot.max_turn_rate)
        _within(values, "acc_lim_x", robot.acceleration)
        _within(values, "acc_lim_theta", robot.turn_acceleration)
        for name, acceleration in (("decel_lim_x", values["acc_lim_x"]), ("decel_lim_theta", values["acc_lim_theta"])):
            values[name] = -acceleration if values[name] is None else values[name]
        values["max_speed_xy"] = values["max_vel_x"] if values["max_speed_xy"] is None else values["max_speed_xy"]
        values["min_vel_x"] = max(values["min_vel_x"], -robot.max_speed)
        lidar = robot.lidar
        values |= costmap | {row.name: getattr(self, row.name) for row in _FURTHER} | {"period": period}
        if lidar is not None:
            forward, leftward, _ = lidar.mount
            values |= {"lidar_forward": forward, "lidar_leftward": leftward, "lidar_range": lidar.range}
        return RobotSettings(values, footprint, critics)

    @property
    def needs_lidar(self) -> bool:
        """True if the costmap has a layer that beams mark."""
        return bool(self.settings(_SOME_ROBOT, 0.05).values["obstacle_layer"])

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        block, _ = self._blocks()
        values, critics = self._values(block), self._critics(block)
        idle: dict[str, str] = {}
        if values["discretize_by_time"]:
            idle |= dict.fromkeys(("linear_granularity", "angular_granularity"), "discretize_by_time is on")
        else:
            idle["time_granularity"] = "discretize_by_time is off"
        if not any(isinstance(critic, RotateToGoal) for critic in critics):
            names = ("xy_goal_tolerance", "trans_stopped_velocity")
            idle |= dict.fromkeys(names, "RotateToGoal, which reads it, is not among the critics")
        if not values["shorten_transformed_plan"]:
            idle["prune_distance"] = "shorten_transformed_plan is off"
        return idle

    def goal_options(self) -> dict[str, float]:
        """Return the options of this class that the critic RotateToGoal reads in Nav2."""
        values = self._values(self._blocks()[0])
        return {row.name: values[row.name] for row in _OF_GOALS}

    def _blocks(self) -> tuple[Nav2Block | None, Nav2Block | None]:
        if self.nav2 is None:
            return (Nav2Block("FollowPath", self.FollowPath) if self.FollowPath else None), None
        follow = nav2_block(self.nav2, "controller_server", "FollowPath")
        local = nav2_block(self.nav2, "local_costmap")
        if follow is None and local is None:
            raise InputError("has neither FollowPath of controller_server nor local_costmap", file=self.nav2)
        return follow, local

    def _values(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return all parameters but the critics."""
        values = settle(self, block)
        if block is None:
            return values
        plugin = block.take("plugin", str, _PLUGIN)
        if plugin != _PLUGIN:
            raise block.error(f"is not {_PLUGIN}", "plugin")
        for name in ("min_vel_y", "max_vel_y"):
            if block.take(name, float, 0.0):
                raise block.error("must be 0, robots cannot drive sideways", name)
        block.ignore(*_IGNORED)
        return values

    def _critics(self, block: Nav2Block | None) -> tuple[Critic, ...]:
        if block is None:
            return self._with_extra(self.critics or DEFAULT)
        names = block.take_names("critics")
        found: list[Critic] = []
        for name in names:
            if name not in NATIVE:
                raise block.error(f"there is no critic {name!r}", "critics", hint=f"known critics: {', '.join(NATIVE)}")
            found.append(NATIVE[name].from_nav2(block))
        block.ignore(*(name for name in NATIVE if name not in names))
        block.refuse_unknown()
        return self._with_extra(self.critics or tuple(found) or DEFAULT)

    def _with_extra(self, critics: tuple[Critic, ...]) -> tuple[Critic, ...]:
        """Add the extra critics.

        Raises:
            InputError: one of Nav2's critics would score twice.
        """
        kinds = {type(critic) for critic in critics}
        if twice := next((critic for critic in self.extra_critics if type(critic) in kinds), None):
            name = type(twice).__name__
            raise InputError(f"extra_critics: {name} is there already", hint="set its scale in `critics`")
        return critics + self.extra_critics


def _within(values: dict[str, Any], name: str, limit: float) -> None:
    """Limit a value to what the robot can do, which is also the default."""
    values[name] = limit if values[name] is None else min(values[name], limit)


_SOME_ROBOT = RobotModel(
    name="any", footprint=np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]), max_speed=1.0, max_turn_rate=1.0
)
_PLUGIN = "dwb_core::DWBLocalPlanner"
_IGNORED = (
    *("debug_trajectory_details", "transform_tolerance", "stateful", "prune_plan", "vy_samples", "acc_lim_y"),
    *(
        "decel_lim_y",
        "sim_period",
        "default_critic_namespaces",
        "goal_checker_name",
        "use_dwa",
        "limit_vel_cmd_in_traj",
    ),
    *("publish_cost_grid_pc", "publish_evaluation", "publish_global_plan", "publish_local_plan"),
    *("publish_trajectories", "publish_transformed_plan", "publish_input_params", "marker_lifetime"),
)
"""Parameters without effect here: of topics, sideways motion and transforms."""
