"""The controller `rpp` (regulated pure pursuit) with names and defaults of Nav2 (lyrical 1.5), limits from the robot.

Macenski, Singh, Martin and Gines, "Regulated pure pursuit for robot path tracking", Autonomous Robots 47, 2023.
"""

from collections.abc import Mapping
from typing import Any, ClassVar

import attrs
from mrpbench_controllers_local import LocalController, limited
from mrpbench_native.local import controller_options

from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
@described(controller_options("rpp"), as_parameter)
@described(controller_options("rpp", further=True))
class Rpp(LocalController):
    """Chases a point on the path, slower in tight turns, near obstacles and near the end (regulated pure pursuit)."""

    native: ClassVar[str] = "rpp"
    nav2_plugin: ClassVar[str] = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
    renamed: ClassVar[Mapping[str, str]] = {
        "desired_linear_vel": "max_linear_vel",
        "max_allowed_time_to_collision": "max_allowed_time_to_collision_up_to_carrot",
    }

    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values within the limits of a robot."""
        spin = robot.max_turn_rate
        for name, limit in (
            ("max_linear_vel", robot.max_speed),
            ("max_angular_vel", spin),
            ("rotate_to_heading_angular_vel", spin),
            ("max_linear_accel", robot.acceleration),
            ("max_angular_accel", robot.turn_acceleration),
        ):
            values[name] = limited(values[name], limit)
        values["min_linear_vel"] = max(values["min_linear_vel"], -robot.max_speed)
        values["min_angular_vel"] = max(values["min_angular_vel"], -spin)
        return values | {"period": period}

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        values = self.read()[0]
        idle = super().idle_options()

        def needs(switch: str, *names: str, on: bool = True) -> None:
            if values[switch] != on:
                idle.update(dict.fromkeys(names, f"{switch} is {'off' if on else 'on'}"))

        needs("use_velocity_scaled_lookahead_dist", "min_lookahead_dist", "max_lookahead_dist", "lookahead_time")
        needs("use_velocity_scaled_lookahead_dist", "lookahead_dist", on=False)
        needs("use_fixed_curvature_lookahead", "curvature_lookahead_dist")
        needs("use_rotate_to_heading", "rotate_to_heading_min_angle")
        needs("use_regulated_linear_velocity_scaling", "regulated_linear_scaling_min_radius")
        needs(
            "use_cost_regulated_linear_velocity_scaling",
            *("cost_scaling_dist", "cost_scaling_gain", "inflation_cost_scaling_factor"),
        )
        needs("use_collision_detection", "max_allowed_time_to_collision_up_to_carrot")
        needs("use_dynamic_window", "min_linear_vel", "max_linear_accel", "max_linear_decel", "max_angular_decel")
        return idle
