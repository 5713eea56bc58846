"""The recipe: DWB with the names and defaults of Nav2 (galactic, humble), limits and footprint from the robot.

Nav2: Macenski et al., "The Marathon 2: A Navigation System", IROS 2020. DWB descends from the dynamic window approach
(Fox, Burgard and Thrun, IEEE Robotics & Automation Magazine 4, 1997).
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, get_args

import attrs
import numpy as np
from attrs.validators import and_, ge, gt, le

from mrpbench_controllers_dwb.costmap import LocalCostmap
from mrpbench_controllers_dwb.critic import Critic
from mrpbench_controllers_dwb.nav2_critics import DEFAULT, NATIVE
from mrpbench_controllers_dwb.settings import RobotSettings
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.api.nav2 import parameter, settle
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block, nav2_block
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World

Generator = Literal["dwb_plugins::StandardTrajectoryGenerator", "dwb_plugins::LimitedAccelGenerator"]


@attrs.frozen(kw_only=True)
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
    min_vel_x: float | None = parameter(0.0, help="lowest speed; negative = may drive back", unit="m/s")
    max_vel_x: float | None = parameter(None, help="highest speed; by default the robot's", unit="m/s", validator=gt(0))
    max_vel_theta: float | None = parameter(
        1.0, help="highest turn rate, within the robot's limit", unit="rad/s", validator=gt(0)
    )
    min_speed_xy: float | None = parameter(
        0.0, help="samples with a lower speed must turn faster than min_speed_theta", unit="m/s"
    )
    max_speed_xy: float | None = parameter(None, help="highest speed in the plane; by default max_vel_x", unit="m/s")
    min_speed_theta: float | None = parameter(
        0.0, help="samples that turn slower than this must drive faster than min_speed_xy", unit="rad/s"
    )
    acc_lim_x: float | None = parameter(None, help="acceleration, m/s^2; by default the robot's", validator=gt(0))
    acc_lim_theta: float | None = parameter(None, help="acceleration, rad/s^2; by default the robot's", validator=gt(0))
    decel_lim_x: float | None = parameter(None, help="deceleration, negative; by default the robot's")
    decel_lim_theta: float | None = parameter(None, help="deceleration, negative; by default the robot's")
    vx_samples: int | None = parameter(20, help="number of speeds that are sampled", validator=and_(ge(1), le(1000)))
    vtheta_samples: int | None = parameter(
        20, help="number of turn rates that are sampled", validator=and_(ge(1), le(1000))
    )
    sim_time: float | None = parameter(1.7, help="duration of a trajectory", unit="s", validator=gt(0))
    linear_granularity: float | None = parameter(0.05, help="longest step of a trajectory", unit="m", validator=gt(0))
    angular_granularity: float | None = parameter(
        0.025, help="largest turn in a step of a trajectory, radians", validator=gt(0)
    )
    discretize_by_time: bool | None = parameter(False, help="step by time_granularity instead of by way and angle")
    time_granularity: float | None = parameter(0.5, help="longest step of a trajectory", unit="s", validator=gt(0))
    include_last_point: bool | None = parameter(True, help="count the last pose twice where scores are summed")
    trajectory_generator_name: Generator | None = parameter(
        "dwb_plugins::StandardTrajectoryGenerator",
        help="accelerate to sampled velocities along the trajectory, or sample only what one period can reach",
    )
    xy_goal_tolerance: float | None = parameter(
        0.25,
        help="distance from the goal at which RotateToGoal begins, within the navigator's",
        unit="m",
        validator=gt(0),
    )
    trans_stopped_velocity: float | None = parameter(
        0.25, help="speed below which RotateToGoal only turns", unit="m/s", validator=ge(0)
    )
    short_circuit_trajectory_evaluation: bool | None = parameter(
        True, help="stop scoring a trajectory that cannot win; false = score all in full, for `explain`"
    )
    prune_distance: float | None = parameter(
        1.0, help="ignore parts of the path that are farther away", unit="m", validator=gt(0)
    )
    shorten_transformed_plan: bool | None = parameter(
        True, help="use prune_distance; if false, half the size of the costmap"
    )
    critics: tuple[Critic, ...] | None = option(
        None, help="critics that score trajectories, in order (default: those of Nav2 for the TurtleBot3)"
    )
    local_costmap: LocalCostmap | None = option(None, help="costmap around each robot (default: as in Nav2)")
    beyond_end: float = option(
        0.35,
        help="prolong the path straight beyond its end by this, for critics that measure distances to it, so that a "
        "robot comes nearer to the end than the 0.25 m of Nav2; 0 = as in Nav2",
        unit="m",
        validator=ge(0),
    )
    rotate_to_path: float = option(
        0.4,
        help="turn on the spot first where a new path leads off the heading by more than this, radians, as the "
        "rotation shim of Nav2 does; 0 = never, as DWB alone",
        validator=ge(0),
    )
    max_detour: float = option(0.5, help="largest distance of a detour from a blocked path", unit="m", validator=ge(0))
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
        del values["xy_goal_tolerance"], values["trans_stopped_velocity"]
        limited = values.pop("trajectory_generator_name") == "dwb_plugins::LimitedAccelGenerator"
        _within(values, "max_vel_x", robot.max_speed)
        _within(values, "max_vel_theta", robot.max_turn_rate)
        _within(values, "acc_lim_x", robot.acceleration)
        _within(values, "acc_lim_theta", robot.turn_acceleration)
        for name, acceleration in (("decel_lim_x", values["acc_lim_x"]), ("decel_lim_theta", values["acc_lim_theta"])):
            values[name] = -acceleration if values[name] is None else values[name]
        values["max_speed_xy"] = values["max_vel_x"] if values["max_speed_xy"] is None else values["max_speed_xy"]
        values["min_vel_x"] = max(values["min_vel_x"], -robot.max_speed)
        lidar = robot.lidar
        numbers = {name: float(value) for name, value in values.items()} | costmap
        numbers |= {"limited": float(limited), "period": period, "max_detour": self.max_detour}
        numbers |= {"beyond_end": self.beyond_end, "rotate_to_path": self.rotate_to_path}
        if lidar is not None:
            forward, leftward, _ = lidar.mount
            numbers |= {"lidar_forward": forward, "lidar_leftward": leftward, "lidar_range": lidar.range}
        return RobotSettings(numbers, footprint, critics)

    def goal_options(self) -> dict[str, float]:
        """Return the options of this class that the critic RotateToGoal reads in Nav2."""
        values = self._values(self._blocks()[0])
        return {name: values[name] for name in ("xy_goal_tolerance", "trans_stopped_velocity")}

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
        if values["trajectory_generator_name"] not in get_args(Generator):
            raise block.error("is not implemented", "trajectory_generator_name")
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
            return self.critics or DEFAULT
        names = block.take_names("critics")
        found: list[Critic] = []
        for name in names:
            if name not in NATIVE:
                raise block.error(f"there is no critic {name!r}", "critics", hint=f"known critics: {', '.join(NATIVE)}")
            found.append(NATIVE[name].from_nav2(block))
        block.ignore(*(name for name in NATIVE if name not in names))
        block.refuse_unknown()
        return self.critics or tuple(found) or DEFAULT


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
