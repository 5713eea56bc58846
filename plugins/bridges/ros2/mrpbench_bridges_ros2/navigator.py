"""The navigator `ros2`: an external stack, such as Nav2, drives the robots along their released paths."""

import time
import weakref
from collections.abc import Sequence
from importlib.metadata import entry_points
from typing import Any, ClassVar

import attrs
import numpy as np
from attrs.validators import gt

from mrpbench_bridges_ros2.commands import Commands, Outside
from mrpbench_bridges_ros2.link import Link
from mrpbench_bridges_ros2.pace import Pace
from mrpbench_bridges_ros2.publisher import Publisher
from mrpbench_core.api import Controller, Navigator, NavigatorSession, option
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.geometry import facing
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.observation import FleetObservation
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World


def _waypoints() -> Any:
    """The core's own navigator, found like any plugin."""
    (entry,) = entry_points(group=Navigator.group, name="waypoints")
    return entry.load()()


@attrs.frozen(kw_only=True)
class Ros2(Navigator):
    """Publishes sensor data and released paths, and drives the robots by `/robot_0/cmd_vel`.

    Each robot's released path is on `/robot_0/released` (nav_msgs/Path), its end on `/robot_0/goal_pose`, as Nav2's
    behaviour tree navigator takes it. The configured `controller` is not asked.
    """

    live: ClassVar[bool] = True

    pace: float = option(1.0, help="largest real-time factor: simulated seconds per second", validator=gt(0))
    silence: float = option(0.5, help="a robot stops after this time without a command", unit="s", validator=gt(0))
    stamped: bool = option(False, help="commands are TwistStamped, as Nav2 sends since Kilted, instead of Twist")
    localization: bool = option(True, help="publish the transform from map to odom; off if the stack does (AMCL)")
    patience: float = option(
        30.0, help="wall time to wait for publishers of commands for every robot", unit="s", validator=gt(0)
    )
    progress: Navigator = option(
        attrs.Factory(_waypoints), help="navigator that decides how far robots got, and when a robot gives up"
    )

    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin when there is a publisher of commands for every robot.

        Raises:
            InputError: ROS 2 is not installed, or no node publishes commands.
        """
        del controller
        link = Link("mrpbench")
        try:
            commands = Commands(link, fleet.names, self.stamped, self.silence)
            inner = self.progress.start(fleet, world, routes, Outside(commands=commands), period, seed)
            publisher = Publisher(link, world, fleet, self.localization)
            session = _Session(self, link, publisher, commands, inner, routes, fleet.names)
            _meet(link, commands, self.patience)
        except BaseException:
            link.close()
            raise
        weakref.finalize(session, link.close)
        return session


def _meet(link: Link, commands: Commands, patience: float) -> None:
    until = time.monotonic() + patience
    while silent := [topic for topic in commands.topics if not link.node.count_publishers(topic)]:
        if time.monotonic() > until:
            raise InputError(
                f"ros2: after {patience:g} s no node publishes {silent[0]}"
                + (f" (nor {len(silent) - 1} more)" if len(silent) > 1 else ""),
                hint="start the outside stack with the same ROS_DOMAIN_ID; the option patience waits longer",
            )
        link.spin(0.05)


class _Session(NavigatorSession):
    def __init__(
        self,
        recipe: Ros2,
        link: Link,
        publisher: Publisher,
        commands: Commands,
        inner: NavigatorSession,
        routes: Sequence[Route],
        names: Sequence[str],
    ) -> None:
        from geometry_msgs.msg import PoseStamped
        from nav_msgs.msg import Path

        from mrpbench_bridges_ros2 import messages

        self._make: Any = messages
        self._link, self._publisher, self._commands, self._inner = link, publisher, commands, inner
        self._pace = Pace(recipe.pace)
        self._paths = [link.publisher(Path, f"/{name}/released", latched=True) for name in names]
        self._goals = [link.publisher(PoseStamped, f"/{name}/goal_pose") for name in names]
        self._reached = [0] * len(names)
        self._take(0.0, routes)

    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        self._inner.adopt(routes, cut)
        if cut is not None:
            self._reached = np.maximum(self._reached - cut, 0).tolist()
        self._take(self._commands.now, routes)

    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        self._commands.now = now
        self._publisher.publish(now, observation)
        for robot, released in enumerate(orders.released.tolist()):
            if released > self._released[robot]:
                self._hand_over(now, robot, released)
        self._link.spin(self._pace.left(now))
        motion = self._inner.step(now, observation, orders)
        self._reached = motion.reached.tolist()
        return motion

    def _take(self, now: float, routes: Sequence[Route]) -> None:
        self._ways = [facing(route.waypoint) for route in routes]
        self._released = [0] * len(routes)
        self._publisher.plans(now, routes)

    def _hand_over(self, now: float, robot: int, released: int) -> None:
        ahead = self._ways[robot][self._reached[robot] : released + 1]
        self._paths[robot].publish(self._make.path(now, ahead))
        self._goals[robot].publish(self._make.pose_stamped(now, ahead[-1]))
        self._released[robot] = released
