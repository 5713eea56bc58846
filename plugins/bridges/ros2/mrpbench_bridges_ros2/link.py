"""The connection to ROS 2: a node with a context of its own, so that runs in one process do not affect each other."""

import importlib.util
import sys
import time
from collections.abc import Callable
from typing import Any

from mrpbench_core.files.errors import InputError

HINT = (
    "source a ROS 2 installation, or with Python 3.11 on Linux: "
    "pip install ros-kilted-rclpy ros-rmw-fastrtps-cpp ros-nav-msgs ros-sensor-msgs"
)


REQUIRED = ("rclpy", "geometry_msgs", "nav_msgs", "rosgraph_msgs", "sensor_msgs")
"""Packages without which nothing is published."""


def missing_packages() -> str | None:
    """Return what is not published because packages of ROS are missing, or None; imports nothing."""
    if missing := [name for name in REQUIRED if not _is_installed(name)]:
        return f"nothing is published: {', '.join(missing)} cannot be imported ({HINT})"
    if not _is_installed("tf2_msgs"):
        return "neither /tf nor /tf_static is published: tf2_msgs cannot be imported"
    return None


def _is_installed(name: str) -> bool:
    if name in sys.modules:
        return sys.modules[name] is not None
    return importlib.util.find_spec(name) is not None


class Link:
    """The connection of one run with ROS."""

    def __init__(self, name: str) -> None:
        """Open a node.

        Raises:
            InputError: ROS 2 is not here, or does not start.
        """
        try:
            import nav_msgs.msg  # noqa: F401
            import rclpy
            import sensor_msgs.msg  # noqa: F401
            from rclpy.executors import SingleThreadedExecutor
            from rclpy.signals import SignalHandlerOptions
        except ImportError as error:
            raise InputError(f"ros2: ROS 2 cannot be imported: {error}", hint=HINT) from error
        self._context = rclpy.Context()
        try:
            rclpy.init(args=[], context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        except Exception as error:  # RCLError is not a public name
            raise InputError(f"ros2: ROS 2 does not start: {' '.join(str(error).split())}") from error
        self.node: Any = rclpy.create_node(name, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._subscriptions = 0

    def publisher(self, kind: type, topic: str, latched: bool = False) -> Any:
        """Return a reliable publisher; a latched one keeps its last message for late subscribers."""
        from rclpy.qos import DurabilityPolicy, QoSProfile

        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        return self.node.create_publisher(kind, topic, QoSProfile(depth=1 if latched else 10, durability=durability))

    def subscribe(self, kind: type, topic: str, take: Callable[[Any], None]) -> None:
        """Have `take` called with the messages of a topic, from within `spin`. Only the newest wait."""
        self.node.create_subscription(kind, topic, take, 1)
        self._subscriptions += 1

    def spin(self, seconds: float) -> None:
        """Process messages that have arrived or arrive within the given wall time."""
        for _ in range(self._subscriptions):  # one callback each, however late we are
            self._executor.spin_once(timeout_sec=0)
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            self._executor.spin_once(timeout_sec=left)

    def close(self) -> None:
        """Leave ROS."""
        self._executor.shutdown()
        self.node.destroy_node()
        self._context.try_shutdown()
