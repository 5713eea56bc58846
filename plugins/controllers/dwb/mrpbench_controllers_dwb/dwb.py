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
from mrpbench_controllers_dwb.critics import DEFAULT, NATIVE
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession, FleetOfOne, option
from mrpbench_core.api.nav2 import parameter, settle
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block, nav2_block
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.world import World

Generator = Literal["dwb_plugins::StandardTrajectoryGenerator", "dwb_plugins::LimitedAccelGenerator"]


@attrs.frozen(kw_only=True)
class Dwb(Controller):
    """Samples velocities, rolls each out, and takes the one that its critics like best."""

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
    min_speed_xy: float | None = parameter(0.0, help="slower samples need min_speed_theta", unit="m/s")
    max_speed_xy: float | None = parameter(None, help="highest speed in the plane; by default max_vel_x", unit="m/s")
    min_speed_theta: float | None = parameter(0.0, help="slower turns need min_speed_xy", unit="rad/s")
    acc_lim_x: float | None = parameter(None, help="acceleration, m/s^2; by default the robot's", validator=gt(0))
    acc_lim_theta: float | None = parameter(None, help="acceleration, rad/s^2; by default the robot's", validator=gt(0))
    decel_lim_x: float | None = parameter(None, help="deceleration, negative; by default the robot's")
    decel_lim_theta: float | None = parameter(None, help="deceleration, negative; by default the robot's")
    vx_samples: int | None = parameter(20, help="speeds that are tried", validator=and_(ge(1), le(1000)))
    vtheta_samples: int | None = parameter(20, help="turn rates that are tried", validator=and_(ge(1), le(1000)))
    sim_time: float | None = parameter(1.7, help="length of a trajectory", unit="s", validator=gt(0))
    linear_granularity: float | None = parameter(0.05, help="longest step of a trajectory", unit="m", validator=gt(0))
    angular_granularity: float | None = parameter(
        0.025, help="largest turn in a step of a trajectory, radians", validator=gt(0)
    )
    discretize_by_time: bool | None = parameter(False, help="steps of time_granularity instead")
    time_granularity: float | None = parameter(0.5, help="longest step of a trajectory", unit="s", validator=gt(0))
    include_last_point: bool | None = parameter(True, help="the last pose counts twice where scores are summed")
    trajectory_generator_name: Generator | None = parameter(
        "dwb_plugins::StandardTrajectoryGenerator",
        help="reach a sampled velocity with the robot's acceleration, or sample what one control period reaches",
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
        True, help="look closely at trajectories that can win only; false = at all, so that every reason is known"
    )
    prune_distance: float | None = parameter(
        1.0, help="farther parts of the path are not looked at", unit="m", validator=gt(0)
    )
    shorten_transformed_plan: bool | None = parameter(True, help="prune_distance counts; else half the costmap does")
    critics: tuple[Critic, ...] | None = option(
        None, help="what scores trajectories, in order (default: those of Nav2's TurtleBot3)"
    )
    local_costmap: LocalCostmap | None = option(None, help="the costmap around each robot (default: as in Nav2)")
    beyond_end: float = option(
        0.35,
        help="the path goes on straight beyond its end for critics that measure distances to it, so that a robot comes "
        "nearer to the end than Nav2's 0.25 m; 0 = as in Nav2",
        unit="m",
        validator=ge(0),
    )
    rotate_to_path: float = option(
        0.4,
        help="radians by which the robot may head off a new path before it turns on the spot first, as with Nav2's "
        "rotation shim; 0 = never, as DWB alone",
        validator=ge(0),
    )
    max_detour: float = option(0.5, help="how far from a blocked path a way around may lead", unit="m", validator=ge(0))
    threads: int = option(1, help="threads that share the robots; results do not depend on it", validator=ge(1))

    def __attrs_post_init__(self) -> None:
        """Read the Nav2 blocks, so that mistakes in them are found before anything runs."""
        if self.FollowPath and self.nav2 is not None:
            raise InputError("give either a Nav2 file or a block FollowPath")
        self.settings(_SOME_ROBOT, 0.05)

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Begin to control one robot."""
        return FleetOfOne(self.start_fleet((robot,), world, period))

    def start_fleet(self, robots: Sequence[RobotModel], world: World, period: float) -> FleetControllerSession:
        """Begin to control a fleet, all robots in one call."""
        from mrpbench_controllers_dwb.session import DwbSession

        return DwbSession(self, robots, world, period)

    def settings(self, robot: RobotModel, period: float) -> tuple[dict[str, float], Float, tuple[Critic, ...]]:
        """What C++ is told of one robot: numbers by name, the footprint f8[k,2], and the critics.

        Raises:
            InputError: a Nav2 file says what makes no sense here.
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
        return numbers, footprint, critics

    def goal_options(self) -> dict[str, float]:
        """The options of this class that the critic RotateToGoal has in Nav2."""
        values = self._values(self._blocks()[0])
        return {name: values[name] for name in ("xy_goal_tolerance", "trans_stopped_velocity")}

    def _blocks(self) -> tuple[Nav2Block | None, Nav2Block | None]:
        if self.nav2 is None:
            return (Nav2Block("FollowPath", self.FollowPath) if self.FollowPath else None), None
        follow = nav2_block(self.nav2, "controller_server", "FollowPath")
        local = nav2_block(self.nav2, "local_costmap")
        if follow is None and local is None:
            raise InputError("has neither controller_server's FollowPath nor local_costmap", file=self.nav2)
        return follow, local

    def _values(self, block: Nav2Block | None) -> dict[str, Any]:
        """All parameters but the critics."""
        values = settle(self, block)
        if block is None:
            return values
        if values["trajectory_generator_name"] not in get_args(Generator):
            raise block.error("is no generator that exists here", "trajectory_generator_name")
        plugin = block.take("plugin", str, _PLUGIN)
        if plugin != _PLUGIN:
            raise block.error(f"is not {_PLUGIN}", "plugin")
        for name in ("min_vel_y", "max_vel_y"):
            if block.take(name, float, 0.0):
                raise block.error("the robots cannot drive sideways", name)
        block.ignore(*_IGNORED)
        return values

    def _critics(self, block: Nav2Block | None) -> tuple[Critic, ...]:
        if block is None:
            return self.critics or DEFAULT
        names = block.take("critics", tuple, ())
        found: list[Critic] = []
        for name in names:
            if name not in NATIVE:
                raise block.error(f"there is no critic {name!r}", "critics", hint=f"there are {', '.join(NATIVE)}")
            found.append(NATIVE[name].from_nav2(block))
        block.ignore(*(name for name in NATIVE if name not in names))
        block.refuse_unknown()
        return self.critics or tuple(found) or DEFAULT


def _within(values: dict[str, Any], name: str, limit: float) -> None:
    """No more than the robot can, which is also the default."""
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
"""Of what does not exist here: topics, sideways motion, transforms."""
