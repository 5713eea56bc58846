"""The controller `graceful` with the names and defaults of Nav2 (lyrical 1.5), limits from the robot.

Park and Kuipers, "A smooth control law for graceful motion of differential wheeled mobile robots in 2D environment",
ICRA 2011.
"""

from collections.abc import Mapping
from typing import Any, ClassVar

import attrs
from mrpbench_controllers_local import LocalController, limited
from mrpbench_native.local import controller_options

from mrpbench_core.api.described import described
from mrpbench_core.api.nav2 import as_parameter
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
@described(controller_options("graceful"), as_parameter)
@described(controller_options("graceful", further=True))
class Graceful(LocalController):
    """Drives smooth curves to a target that moves along the path (control law of Park and Kuipers)."""

    native: ClassVar[str] = "graceful"
    nav2_plugin: ClassVar[str] = "nav2_graceful_controller::GracefulController"
    renamed: ClassVar[Mapping[str, str]] = {
        "lambda": "lambda_",  # a keyword of Python
        "motion_target_dist": "max_lookahead",
        "initial_rotation_min_angle": "initial_rotation_tolerance",
    }

    def settled(self, block: Nav2Block | None) -> dict[str, Any]:
        """Return the values of the options of Nav2."""
        values = super().settled(block)
        if block is not None and not block.take("final_rotation", bool, True):  # of humble
            raise block.error("must be true, robots take the yaw of their goal", "final_rotation")
        return values

    def limits(self, values: dict[str, Any], robot: RobotModel, period: float) -> dict[str, Any]:
        """Return the values within the limits of a robot."""
        del period
        values["v_linear_max"] = limited(values["v_linear_max"], robot.max_speed)
        values["v_linear_min"] = limited(values["v_linear_min"], values["v_linear_max"])
        values["v_angular_max"] = limited(values["v_angular_max"], robot.max_turn_rate)
        return values

    def idle_options(self) -> dict[str, str]:
        """Return options that the others make idle."""
        values = self.read()[0]
        idle = super().idle_options()
        if not values["initial_rotation"]:
            idle["initial_rotation_tolerance"] = "initial_rotation is off"
        if not values["use_collision_detection"]:
            idle["in_place_collision_resolution"] = "use_collision_detection is off"
        return idle
