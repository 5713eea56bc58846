"""LastController: turn towards the path, then drive along it."""

import math
from itertools import pairwise

import attrs
from mrpbench_core.api import Controller, ControllerSession, option
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observation
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastController(Controller):
    """Turns on the spot until the robot faces the path, and slows down before its end."""

    lookahead: float = option(0.15, help="distance of the target point", unit="m", validator=attrs.validators.gt(0))
    facing: float = option(0.5, help="largest heading error at which the robot drives", unit="rad")

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:  # noqa: ARG002
        """Begin to control one robot."""
        return LastControllerSession(self, robot)


class LastControllerSession(ControllerSession):
    """Controls one robot."""

    def __init__(self, options: LastController, robot: RobotModel) -> None:
        self.options = options
        self.robot = robot

    def command(self, observation: Observation) -> tuple[float, float]:
        """Return forward speed and turn rate."""
        x, y, yaw = observation.pose.tolist()
        path = observation.path.tolist()
        left = math.dist((x, y), path[-1])
        if left < 0.03:
            wanted = 0.0 if math.isnan(observation.yaw) else math.remainder(observation.yaw - yaw, math.tau)
            return 0.0, self.limited(2 * wanted)
        aim = along(path, self.options.lookahead)
        error = math.remainder(math.atan2(aim[1] - y, aim[0] - x) - yaw, math.tau)
        if abs(error) > self.options.facing:
            return 0.0, self.limited(2 * error)
        return min(self.robot.max_speed, observation.speed, left), self.limited(2 * error)

    def limited(self, rate: float) -> float:
        """Return a turn rate within the limits of the robot."""
        return max(-self.robot.max_turn_rate, min(self.robot.max_turn_rate, rate))


def along(path: list[list[float]], distance: float) -> list[float]:
    """Return the point at a distance from the beginning of a path, or its end."""
    for begin, end in pairwise(path):
        length = math.dist(begin, end)
        if distance <= length:
            share = distance / length if length else 0.0
            return [a + share * (b - a) for a, b in zip(begin, end, strict=True)]
        distance -= length
    return path[-1]
