"""Commands from an external stack, on `/robot_0/cmd_vel`."""

import math
from collections.abc import Sequence
from typing import Any

import attrs

from mrpbench_bridges_ros2.link import Link
from mrpbench_core.api import Controller, ControllerSession, FleetControllerSession
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observation
from mrpbench_core.model.worlds.world import World


class Commands:
    """The newest command of each robot."""

    def __init__(self, link: Link, names: Sequence[str], stamped: bool, silence: float) -> None:
        """Subscribe; a command holds for `silence` simulated seconds."""
        from geometry_msgs.msg import Twist, TwistStamped

        self.topics = [f"/{name}/cmd_vel" for name in names]
        self.now = 0.0
        self._silence = silence
        self._newest: dict[int, tuple[float, float, float]] = {}
        for robot, topic in enumerate(self.topics):
            link.subscribe(TwistStamped if stamped else Twist, topic, self._taker(robot, stamped))

    def of(self, robot: int) -> tuple[float, float]:
        """Speed (m/s) and turn rate (rad/s): zero before the first command, and after some silence."""
        heard, speed, turn = self._newest.get(robot, (-math.inf, 0.0, 0.0))
        return (speed, turn) if self.now - heard <= self._silence else (0.0, 0.0)

    def _taker(self, robot: int, stamped: bool) -> Any:
        def take(message: Any) -> None:
            twist = message.twist if stamped else message
            if math.isfinite(twist.linear.x) and math.isfinite(twist.angular.z):
                self._newest[robot] = self.now, twist.linear.x, twist.angular.z

        return take


@attrs.frozen(kw_only=True)
class Outside(Controller):
    """Passes all commands on unchanged."""

    commands: Commands

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:
        """Control a robot that is alone."""
        del robot, world, period
        return _Wheels(self.commands, 0)

    def start_fleet(
        self, robots: Sequence[RobotModel], world: World, period: float, seed: int = 0
    ) -> FleetControllerSession:
        """Control all robots."""
        del world, period, seed
        return FleetControllerSession([_Wheels(self.commands, robot) for robot in range(len(robots))])


class _Wheels(ControllerSession):
    def __init__(self, commands: Commands, robot: int) -> None:
        self._commands, self._robot = commands, robot

    def command(self, observation: Observation) -> tuple[float, float]:
        del observation
        return self._commands.of(self._robot)
