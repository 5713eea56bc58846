"""The controller `mppi` with the names and defaults of Nav2 (lyrical 1.5), limits from the robot.

Williams, Drews, Goldfain, Rehg and Theodorou, "Aggressive driving with model predictive path integral control", ICRA
2016.
"""

from typing import Any, ClassVar

import attrs
from mrpbench_controllers_local import Critic, LocalController, chosen, limited, with_prediction
from mrpbench_native.local import controller_options

from mrpbench_controllers_mppi.critic import MppiCritic
from mrpbench_controllers_mppi.nav2_critics import DEFAULT, NATIVE, PredictedObstacleCritic
from mrpbench_core.api import option
from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter, read_option
from mrpbench_core.api.predictor import Predictor
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.model.common.fleet import RobotModel

_VALIDATOR = "DefaultOptimalTrajectoryValidator"
_SIDEWAYS = "robots cannot drive sideways"


@attrs.frozen(kw_only=True)
@described(controller_options("mppi"), as_parameter)
@described(controller_options("mppi", further=True))
class Mppi(LocalController):
    """Samples trajectories around the last plan and averages them by their scores (model predictive path integral)."""

    native: ClassVar[str] = "mppi"
    nav2_plugin: ClassVar[str] = "nav2_mppi_controller::MPPIController"

    critics: tuple[MppiCritic, ...] | None = option(
        None,
        help="critics that score trajectories, in order; default, with weights: "
        + ", ".join(f"{type(critic).__name__} {critic.weight:g}" for critic in DEFAULT),
    )
    extra_critics: tuple[MppiCritic, ...] = option(
        (), help="critics in addition to those of `critics` or of the Nav2 file"
    )

    prediction: Predictor | None = option(
        None,
        help="predicts where people and others who are not planned will be, for the critic PredictedObstacleCritic",
    )

    def settled(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return the values of the options of Nav2; the motion models DiffDrive and Ackermann are supported."""
        values = super().settled(block)
        if block is None:
            return values
        radius = self._turning_radius(block)
        if radius is not None and attrs.asdict(self, recurse=False)["min_turning_r"] is None:
            values["min_turning_r"] = radius
        validator = block.within("TrajectoryValidator")
        validator.not_used("consider_footprint")
        plugin = validator.take("plugin", str, _VALIDATOR)
        if plugin.rpartition("::")[2] != _VALIDATOR:
            raise validator.error(f"must be {_VALIDATOR}, got {plugin!r}", "plugin")
        seconds = read_option(self, "collision_lookahead_time", validator)
        return values if seconds is None else values | {"collision_lookahead_time": seconds}

    def _turning_radius(self, block: Nav2Block) -> float | None:
        """Return the least radius of the motion model, None of DiffDrive: a name, since lyrical the id of a block."""
        named = block.take("motion_model", str, "DiffDrive")
        model = block.within(named)
        kind = model.take("plugin", str, named).rpartition("::")[2].removesuffix("MotionModel")
        kind = {"diff_drive": "DiffDrive", "ackermann": "Ackermann"}.get(kind, kind)
        if kind not in ("DiffDrive", "Ackermann"):
            raise block.error(f"must be DiffDrive or Ackermann, got {kind!r}", "motion_model", hint=_SIDEWAYS)
        limits = model if "min_turning_r" in model else block.within("AckermannConstraints")
        radius: float = limits.take("min_turning_r", float, 0.2)
        if radius <= 0:
            raise limits.error("must be above 0", "min_turning_r")
        return radius if kind == "Ackermann" else None

    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values within the limits of a robot."""
        for name, limit in (
            ("vx_max", robot.max_speed),
            ("wz_max", robot.max_turn_rate),
            ("ax_max", robot.acceleration),
            ("az_max", robot.turn_acceleration),
        ):
            values[name] = limited(values[name], limit)
        values["ax_min"] = max(values["ax_min"], -robot.acceleration)
        values["vx_min"] = max(values["vx_min"], -robot.max_speed)
        return values | {"period": period}

    def chosen_critics(self, block: Nav2Block | None) -> tuple[Critic, ...]:
        """Return the critics of the options, or else of the block, or else of the default."""
        critics = chosen(block, NATIVE, own=self.critics, extra=self.extra_critics, default=DEFAULT)
        return with_prediction(critics, PredictedObstacleCritic(), self.prediction)

    @property
    def predictor(self) -> Predictor | None:
        """What predicts objects for the critic PredictedObstacleCritic."""
        return self.prediction
