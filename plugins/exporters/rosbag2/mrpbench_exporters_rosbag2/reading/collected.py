"""Collects the poses in a bag by robot and source, in one pass."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import attrs

from mrpbench_exporters_rosbag2.messages import SECOND
from mrpbench_exporters_rosbag2.reading.names import robot_in
from mrpbench_exporters_rosbag2.reading.series import Series

POSES = tuple(
    f"{package}/msg/{name}"
    for package, name in (
        ("nav_msgs", "Odometry"),
        ("geometry_msgs", "PoseStamped"),
        ("geometry_msgs", "PoseWithCovarianceStamped"),
    )
)
TRANSFORMS, FLEET = "tf2_msgs/msg/TFMessage", "rmf_fleet_msgs/msg/FleetState"

Take = Callable[[int, Any], None]
"""Handles a message with its log time."""


@attrs.define(kw_only=True)
class Collected:
    """Series by source."""

    poses: dict[tuple[str, str], Series] = attrs.field(factory=dict)
    """By robot and source."""
    frames: dict[tuple[str, str], Series] = attrs.field(factory=dict)
    """Transforms by tree (the robot with this topic, or '' for the common tree) and child frame."""
    static: dict[tuple[str, str], Series] = attrs.field(factory=dict)
    """Static transforms."""

    @property
    def series(self) -> Iterator[Series]:
        """All that have a clock."""
        yield from self.poses.values()
        yield from self.frames.values()

    def of_pose(self, robot: str, source: str, topic: str) -> Take:
        """Takes messages with a pose."""
        series = self.poses.setdefault((robot, source), Series(topic))

        def take(logged: int, message: Any) -> None:
            pose = message.pose
            pose = getattr(pose, "pose", pose)  # some messages nest it next to a covariance
            series.frame = message.header.frame_id.lstrip("/")
            series.add(nanoseconds(message.header.stamp), logged, pose.position, pose.orientation)

        return take

    def of_fleet(self, topic: str, fleet: str) -> Take:
        """Takes states of a fleet of Open-RMF; `fleet` = the only one wanted, or ''."""

        def take(logged: int, message: Any) -> None:
            if fleet in ("", message.name):
                for robot in message.robots:
                    at = robot.location
                    series = self.poses.setdefault((robot.name, "fleet_states"), Series(topic))
                    series.put(nanoseconds(at.t), logged, (at.x, at.y, at.yaw, math.nan), at.level_name)

        return take

    def of_transforms(self, tree: str, topic: str, static: bool) -> Take:
        """Takes transforms; of a frame with two parents, those of the first."""
        series_of = self.static if static else self.frames

        def take(logged: int, message: Any) -> None:
            for said in message.transforms:
                child, parent = said.child_frame_id.lstrip("/"), said.header.frame_id.lstrip("/")
                series = series_of.get((tree, child))
                if series is None:
                    series = series_of[tree, child] = Series(f"{topic}: {parent} to {child}", parent)
                if series.frame == parent:
                    place = said.transform
                    series.add_transform(nanoseconds(said.header.stamp), logged, place.translation, place.rotation)

        return take


@attrs.frozen(kw_only=True)
class Patterns:
    """Patterns of the topics; see the options of the importer."""

    by_source: Mapping[str, tuple[str, ...]]
    tf: tuple[str, ...]
    fleet_states: tuple[str, ...]
    fleet: str

    def takers(self, topics: Mapping[str, str], into: Collected) -> dict[str, Take]:
        """Return the handler of each topic with poses; `topics` gives types by name."""
        takers: dict[str, Take] = {}
        for topic, kind in topics.items():
            if kind in POSES:
                for source, patterns in self.by_source.items():
                    if (robot := robot_in(topic, patterns)) is not None:
                        takers[topic] = into.of_pose(robot, source, topic)
                        break
            elif kind == FLEET and topic in self.fleet_states:
                takers[topic] = into.of_fleet(topic, self.fleet)
            elif kind == TRANSFORMS:
                static = topic.endswith("_static")
                name = topic.removesuffix("_static")
                if name == "/tf":
                    takers[topic] = into.of_transforms("", topic, static)
                elif (robot := robot_in(name, self.tf)) is not None:
                    takers[topic] = into.of_transforms(robot, topic, static)
        return takers


def nanoseconds(stamp: Any) -> int:
    """Return a builtin_interfaces/Time in nanoseconds."""
    return int(stamp.sec) * SECOND + int(stamp.nanosec)
