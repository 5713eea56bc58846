"""The controller `dwb` with the names and defaults of Nav2 (galactic, humble), limits and footprint from the robot.

Nav2: Macenski et al., "The Marathon 2: A Navigation System", IROS 2020. DWB descends from the dynamic window approach
(Fox, Burgard and Thrun, IEEE Robotics & Automation Magazine 4, 1997).
"""

from typing import Any, ClassVar

import attrs
from mrpbench_controllers_local import Critic as AnyCritic
from mrpbench_controllers_local import LocalController, NativeCritic, chosen, limited, with_prediction
from mrpbench_native.local import controller_options, critic_options
from mrpbench_native.options import Option

from mrpbench_controllers_dwb.critic import Critic
from mrpbench_controllers_dwb.nav2_critics import DEFAULT, NATIVE, OF_CONTROLLER, PredictedObstacle, RotateToGoal
from mrpbench_core.api import option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, read_option
from mrpbench_core.api.predictor import Predictor
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.model.common.fleet import RobotModel

_OF_ROBOTS = ("max_vel_x", "max_speed_xy", "acc_lim_x", "acc_lim_theta", "decel_lim_x", "decel_lim_theta")
"""Parameters whose defaults follow from the robot."""
_OF_GOALS = tuple(row for row in critic_options("dwb", "RotateToGoal") if row.name in OF_CONTROLLER)


def _declare(row: Option) -> tuple[Any, Any]:
    return as_parameter(row, unset=row.name in _OF_ROBOTS)


@attrs.frozen(kw_only=True)
@described([*controller_options("dwb"), *_OF_GOALS], _declare)
@described(controller_options("dwb", further=True))
class Dwb(LocalController):
    """Samples velocities, simulates each, and takes the one with the best score of its critics."""

    native: ClassVar[str] = "dwb"
    nav2_plugin: ClassVar[str] = "dwb_core::DWBLocalPlanner"

    critics: tuple[Critic, ...] | None = option(
        None,
        help="critics that score trajectories, in order; default, with scales: "
        + ", ".join(f"{type(critic).__name__} {critic.scale:g}" for critic in DEFAULT),
    )
    extra_critics: tuple[Critic, ...] = option((), help="critics in addition to those of `critics` or of the Nav2 file")

    prediction: Predictor | None = option(
        None, help="predicts where people and others who are not planned will be, for the critic PredictedObstacle"
    )

    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values within the limits of a robot."""
        limits = {name: value for name, value in values.items() if name not in OF_CONTROLLER}
        for name, limit in (
            ("max_vel_x", robot.max_speed),
            ("max_vel_theta", robot.max_turn_rate),
            ("acc_lim_x", robot.acceleration),
            ("acc_lim_theta", robot.turn_acceleration),
        ):
            limits[name] = limited(limits[name], limit)
        for name, acceleration in (("decel_lim_x", limits["acc_lim_x"]), ("decel_lim_theta", limits["acc_lim_theta"])):
            limits[name] = -acceleration if limits[name] is None else limits[name]
        limits["max_speed_xy"] = limits["max_vel_x"] if limits["max_speed_xy"] is None else limits["max_speed_xy"]
        limits["min_vel_x"] = max(limits["min_vel_x"], -robot.max_speed)
        return limits | {"period": period}

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        values, critics, _ = self.read()
        idle = super().idle_options()
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

    def critic_parameters(self, critic: NativeCritic) -> dict[str, Any]:
        """Return the options of a critic; RotateToGoal reads two of the controller in Nav2."""
        if not isinstance(critic, RotateToGoal):
            return critic.parameters
        values = self.read()[0]
        return critic.parameters | {name: values[name] for name in OF_CONTROLLER}

    def settled(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return the values of the options of Nav2, before the limits of a robot."""
        values = super().settled(block)
        if block is None:
            return values
        for name in ("min_vel_y", "max_vel_y"):
            if block.take(name, float, 0.0):
                raise block.error("must be 0, robots cannot drive sideways", name)
        # since iron, where `prune_distance` is that behind
        forward = read_option(self, "prune_distance", block, "forward_prune_distance")
        return values if forward is None else values | {"prune_distance": forward}

    def chosen_critics(self, block: Nav2Block | None) -> tuple[AnyCritic, ...]:
        """Return the critics of the options, or else of the block, or else of the default."""
        critics = chosen(block, NATIVE, own=self.critics, extra=self.extra_critics, default=DEFAULT)
        return with_prediction(critics, PredictedObstacle(), self.prediction)

    @property
    def predictor(self) -> Predictor | None:
        """What predicts objects for the critic PredictedObstacle."""
        return self.prediction
