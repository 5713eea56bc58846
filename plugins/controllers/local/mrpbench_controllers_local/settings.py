"""The parameters of one robot for the native part."""

from typing import Any, NamedTuple

from mrpbench_controllers_local.critics import Critic
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


def lidar_values(robot: RobotModel) -> dict[str, Any]:
    """Return the options of a costmap that tell where the lidar of a robot is; none without a lidar."""
    if robot.lidar is None:
        return {}
    forward, leftward, _ = robot.lidar.mount
    return {"lidar_forward": forward, "lidar_leftward": leftward, "lidar_range": robot.lidar.range}


class RobotSettings(NamedTuple):
    """Settings of one robot, from the recipe, its Nav2 file and the robot's limits."""

    values: dict[str, Any]
    """Options of the controller and the costmap, by name."""
    footprint: Float
    """f8[k,2] metres."""
    critics: tuple[Critic, ...] = ()
