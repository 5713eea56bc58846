"""Collects odometry, commands and scans of robots in one pass."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.format import Signal
from mrpbench_core.model.common.arrays import Int
from mrpbench_exporters_rosbag2.messages import SECOND
from mrpbench_exporters_rosbag2.reading.collected import Take, nanoseconds
from mrpbench_exporters_rosbag2.reading.names import robot_in
from mrpbench_exporters_rosbag2.reading.series import Series, Span, yaw


@attrs.define
class Said:
    """Rows of one robot and channel."""

    topic: str
    stamps: list[int] = attrs.field(factory=list)
    """nanoseconds; of messages that have none, 0."""
    logged: list[int] = attrs.field(factory=list)
    rows: list[Any] = attrs.field(factory=list)


@attrs.frozen(kw_only=True)
class Signals:
    """Collects them. `patterns` are those of the topics of each channel."""

    patterns: Mapping[str, tuple[str, ...]]
    said: dict[tuple[str, str], Said] = attrs.field(factory=dict)
    """By robot and channel."""

    def takers(self, topics: Mapping[str, str]) -> dict[str, Take]:
        """Return the handler of each topic; `topics` gives types by name."""
        takers = {}
        for topic, kind in topics.items():
            for channel, patterns in self.patterns.items():
                read = READ[channel].get(kind)
                robot = robot_in(topic, patterns)
                if read is not None and robot is not None and (robot, channel) not in self.said:
                    self.said[robot, channel] = Said(topic)
                    takers[topic] = _taking(self.said[robot, channel], read)
        return takers

    def placed(self, clocks: Mapping[str, Series], anybody: Series, span: Span, begin: int) -> Iterator[Signal]:
        """Signals with times since `begin` (nanoseconds).

        Messages without stamps are put on the clock of stamped ones by their log times: `clocks` are series of poses
        by robot, `anybody` is that of robots that have none.
        """
        for (robot, channel), said in self.said.items():
            if channel == "truth":  # which tracks give
                continue
            logged = np.array(said.logged, np.int64)
            stamps = logged if span.use_log else np.array(said.stamps, np.int64)
            if not span.use_log and not stamps.any():
                stamps = logged + _ahead(clocks.get(robot, anybody), logged)
            chosen_rows = np.flatnonzero((logged >= span.since) & (logged < span.until))
            chosen_rows = chosen_rows[np.argsort(stamps[chosen_rows], kind="stable")]
            chosen_rows = (
                chosen_rows[np.append(np.diff(stamps[chosen_rows]) > 0, True)] if len(chosen_rows) else chosen_rows
            )
            if len(chosen_rows):
                rows = table([said.rows[index] for index in chosen_rows])
                yield Signal(
                    robot=robot,
                    channel=channel,
                    topic=said.topic,
                    time=(stamps[chosen_rows] - begin) / SECOND,
                    rows=rows,
                )


def turn(orientation: Any) -> float:
    """Yaw of a quaternion; exactly the original yaw, if that was between -2 pi and 2 pi."""
    if orientation.x == orientation.y == 0 and (orientation.z or orientation.w):
        return 2 * math.atan2(orientation.z, orientation.w)
    return yaw(orientation)


def _taking(said: Said, read: Callable[[Any], Any]) -> Take:
    def take(logged: int, message: Any) -> None:
        row = read(message)
        if row is not None:
            said.stamps.append(nanoseconds(message.header.stamp) if hasattr(message, "header") else 0)
            said.logged.append(logged)
            said.rows.append(row)

    return take


def _ahead(clock: Series, logged: Int) -> Int:
    """Nanoseconds by which stamps are ahead of log times, at the given log times."""
    known = np.array(clock.logged, np.int64)
    offset = np.array(clock.stamps, np.int64) - known
    order = np.argsort(known, kind="stable")
    nearest = np.clip(np.searchsorted(known[order], logged), 0, len(known) - 1)
    return offset[order][nearest]


def table(rows: list[Any]) -> NDArray[Any]:
    """Rows as one array; short ones (of scans) are filled with NaN."""
    filled = np.full((len(rows), max(map(len, rows))), np.nan, np.asarray(rows[0]).dtype)
    for index, row in enumerate(rows):
        filled[index, : len(row)] = row
    return filled


def _moved(message: Any) -> tuple[float, ...] | None:
    pose, twist = message.pose.pose, message.twist.twist
    place = (pose.position.x, pose.position.y, turn(pose.orientation))
    return _finite((*place, twist.linear.x, twist.angular.z))


def _told(message: Any) -> tuple[float, ...] | None:
    return _finite((message.linear.x, message.angular.z))


def _finite(row: tuple[float, ...]) -> tuple[float, ...] | None:
    return row if all(map(math.isfinite, row)) else None


READ: Mapping[str, Mapping[str, Callable[[Any], Any]]] = {
    "truth": {"nav_msgs/msg/Odometry": _moved},
    "odometry": {"nav_msgs/msg/Odometry": _moved},
    "command": {
        "geometry_msgs/msg/Twist": _told,
        "geometry_msgs/msg/TwistStamped": lambda message: _told(message.twist),
    },
    "scan_ranges": {"sensor_msgs/msg/LaserScan": lambda message: np.asarray(message.ranges, np.float32)},
}
"""Rows from messages by channel and type; None where a number is not finite."""
