"""The parameters of one robot for the native part."""

from typing import Any, NamedTuple

from mrpbench_controllers_local.critics import Critic
from mrpbench_core.model.common.arrays import Float


class RobotSettings(NamedTuple):
    """Settings of one robot, from the recipe, its Nav2 file and the robot's limits."""

    values: dict[str, Any]
    """Options of the controller and the costmap, by name."""
    footprint: Float
    """f8[k,2] metres."""
    critics: tuple[Critic, ...] = ()
