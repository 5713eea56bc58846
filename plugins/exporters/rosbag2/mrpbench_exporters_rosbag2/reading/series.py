"""Series of stamped planar poses, and the part of a recording in which its clock does not jump."""

import math
from collections.abc import Iterable
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_exporters_rosbag2.messages import SECOND

BACK, AHEAD = SECOND, 3600 * SECOND
"""Difference of two successive stamps from which the clock has jumped; a smaller one is disorder or a gap."""


@attrs.define
class Series:
    """Poses of one thing from one publisher."""

    topic: str
    frame: str = ""
    """Frame of the poses."""
    stamps: list[int] = attrs.field(factory=list)
    """nanoseconds."""
    logged: list[int] = attrs.field(factory=list)
    rows: list[tuple[float, float, float, float]] = attrs.field(factory=list)
    """x, y, yaw, z."""
    levels: list[str] = attrs.field(factory=list)
    jumps: list[tuple[int, int]] = attrs.field(factory=list)
    """Log time at which, and by how much, the clock jumped."""
    refused: int = 0
    """Poses that are not finite."""

    def add(self, stamp: int, logged: int, position: Any, orientation: Any) -> None:
        """Append a pose of geometry_msgs."""
        self.put(stamp, logged, (position.x, position.y, yaw(orientation), position.z))

    def add_transform(self, stamp: int, logged: int, position: Any, orientation: Any) -> None:
        """Append a transform, which is of no use without a rotation."""
        if math.isfinite(yaw(orientation)):
            self.add(stamp, logged, position, orientation)
        else:
            self.refused += 1

    def put(self, stamp: int, logged: int, row: tuple[float, float, float, float], level: str | None = None) -> None:
        """Append x, y, yaw and z (NaN = unknown), if x and y are finite."""
        if not all(map(math.isfinite, row[:2])):
            self.refused += 1
            return
        if not math.isfinite(row[2]):
            row = (*row[:2], math.nan, row[3])
        if self.stamps and not -BACK <= stamp - self.stamps[-1] <= AHEAD:
            self.jumps.append((logged, stamp - self.stamps[-1]))
        self.stamps.append(stamp)
        self.logged.append(logged)
        self.rows.append(row)
        if level is not None:
            self.levels.append(level)

    def ordered(self, use_log: bool, since: int, until: int) -> "Ordered | None":
        """Poses with `since` <= log time < `until` in order of time, of equal stamps the last; None if none."""
        logged = np.array(self.logged, np.int64)
        rows = np.flatnonzero((logged >= since) & (logged < until))
        if not len(rows):
            return None
        stamps = logged if use_log else np.array(self.stamps, np.int64)
        order = rows[np.argsort(stamps[rows], kind="stable")]
        times = stamps[order]
        last = np.append(np.diff(times) > 0, True)
        order = order[last]
        levels = tuple(self.levels[index] for index in order) if self.levels else ()
        return Ordered(stamps[order], np.array(self.rows, float).reshape(-1, 4)[order], levels)


@attrs.frozen
class Ordered:
    """Poses in order of time."""

    stamps: Int
    """i8[k] nanoseconds, strictly increasing."""
    rows: Float
    """f8[k,4]: x, y, yaw, z."""
    levels: tuple[str, ...] = ()


@attrs.frozen
class Span:
    """The part of a recording in which its clock runs evenly."""

    use_log: bool
    """True if log times are used as stamps, because some topic has no stamps."""
    since: int
    until: int
    note: str | None = None


def longest_even_span(series: Iterable[Series]) -> Span:
    """Return the part between two jumps of the clock that has most poses."""
    every = [one for one in series if one.stamps]
    use_log = any(not any(one.stamps) for one in every)
    jumps = sorted((jump, by, one.topic) for one in every for jump, by in one.jumps)
    if use_log or not jumps:
        return Span(use_log, -(2**63), 2**63 - 1)
    logged = np.concatenate([np.array(one.logged, np.int64) for one in every])
    edges = np.unique([-(2**63), *(jump for jump, _, _ in jumps), 2**63 - 1])
    counts = np.diff(np.searchsorted(np.sort(logged), edges))
    best = int(np.argmax(counts))
    _, by, topic = jumps[0]
    way = "ahead" if by > 0 else "back"
    note = (
        f"the clock jumps {way} by {abs(by) / SECOND:.1f} s ({topic}; {len(edges) - 2} times in all): used is the part "
        f"without a jump that has most poses, {int(counts[best])} of {len(logged)}"
    )
    return Span(False, int(edges[best]), int(edges[best + 1]), note)


def yaw(orientation: Any) -> float:
    """Turn about the vertical of a quaternion of any length, NaN for one of length 0."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    if x == y == z == w == 0:
        return math.nan
    return math.atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z)
