"""Publish a running simulation: sensor data and estimates of robots, the map, and paths."""

import logging
from collections.abc import Sequence
from typing import Any

import numpy as np

from mrpbench_bridges_ros2.link import Link
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.geometry import facing
from mrpbench_core.model.execution.observation import FleetObservation
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World

LOG = logging.getLogger("mrpbench.ros2")
CELL_SIZE = 0.05
"""metres, of `/map`; a world that is a raster keeps its own."""


class Publisher:
    """The topics of the bags that a robot's own computer would have: nothing here tells the truth."""

    def __init__(self, link: Link, world: World, fleet: Fleet, localization: bool = True) -> None:
        """Publish constant data. Without `localization`, another node publishes the transform from `map`."""
        from nav_msgs.msg import Odometry, Path
        from rosgraph_msgs.msg import Clock
        from sensor_msgs.msg import LaserScan

        from mrpbench_bridges_ros2 import messages

        self._make: Any = messages
        self._fleet, self._names = fleet, fleet.names
        self._elevation = [level.elevation for level in world.levels]
        self._localization = localization
        self._clock = link.publisher(Clock, "/clock")
        self._plans = [link.publisher(Path, f"/{name}/plan", latched=True) for name in self._names]
        self._odometry = [link.publisher(Odometry, f"/{name}/odom") for name in self._names]
        self._scans = {
            robot: link.publisher(LaserScan, f"/{name}/scan")
            for robot, name in enumerate(self._names)
            if fleet.robots[robot].lidar
        }
        self._maps = self._say_maps(link, world)
        self._transforms: Any = None
        try:
            from tf2_msgs.msg import TFMessage
        except ImportError:
            LOG.warning("tf2_msgs is not installed: neither /tf nor /tf_static is published")
        else:
            self._transforms, self._message = link.publisher(TFMessage, "/tf"), TFMessage
            self._mounts = link.publisher(TFMessage, "/tf_static", latched=True)
            self._mounts.publish(TFMessage(transforms=list(self._say_mounts())))

    def plans(self, now: float, routes: Sequence[Route]) -> None:
        """Publish whole paths."""
        for publisher, route in zip(self._plans, routes, strict=True):
            height = self._elevation[int(route.level[0])]
            publisher.publish(self._make.path(now, facing(route.waypoint), height))

    def publish(self, now: float, observation: FleetObservation) -> None:
        """Publish one control period: the clock, frames before data that use them, odometry, new scans."""
        from rosgraph_msgs.msg import Clock

        self._clock.publish(Clock(clock=self._make.stamp(now)))
        driven = observation.odometry.pose
        if self._transforms is not None:
            self._transforms.publish(self._message(transforms=list(self._frames(now, observation))))
        for name, publisher, pose, twist in zip(
            self._names, self._odometry, driven, observation.odometry.twist, strict=True
        ):
            publisher.publish(self._make.odometry(now, name, pose, twist))
        for batch in observation.scans:
            for robot, ranges in zip(batch.robot.tolist(), batch.ranges, strict=True):
                lidar = self._fleet.robots[robot].lidar
                self._scans[robot].publish(self._make.scan(batch.stamp, self._names[robot], lidar, ranges))

    def _frames(self, now: float, observation: FleetObservation) -> Any:
        driven = observation.odometry.pose
        origins = _parents(observation.estimate.pose, driven)
        for name, origin, pose, level in zip(self._names, origins, driven, observation.level.tolist(), strict=True):
            if self._localization:
                yield self._make.transform(now, "map", f"{name}/odom", origin, self._elevation[level])
            yield self._make.transform(now, f"{name}/odom", f"{name}/base_footprint", pose)

    def _say_mounts(self) -> Any:
        for name, robot in zip(self._names, self._fleet.robots, strict=True):
            if robot.lidar:
                x, y, z = robot.lidar.mount
                yield self._make.transform(0.0, f"{name}/base_footprint", f"{name}/base_scan", (x, y, 0.0), z)

    def _say_maps(self, link: Link, world: World) -> list[Any]:
        from nav_msgs.msg import OccupancyGrid

        publishers = []
        for index, level in enumerate(world.levels):
            publisher = link.publisher(OccupancyGrid, f"/map_{index}" if index else "/map", latched=True)
            publisher.publish(self._make.occupancy_grid(level, CELL_SIZE))
            publishers.append(publisher)
        return publishers


def _parents(outer: Float, inner: Float) -> Float:
    """Poses f8[n,3] of the frames in which robots stand at `inner` while they stand at `outer` outside."""
    yaw = outer[:, 2] - inner[:, 2]
    cos, sin = np.cos(yaw), np.sin(yaw)
    x = outer[:, 0] - cos * inner[:, 0] + sin * inner[:, 1]
    y = outer[:, 1] - sin * inner[:, 0] - cos * inner[:, 1]
    return np.stack([x, y, yaw], axis=-1)
