"""Near misses: robots whose bodies come close to one another without touching."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mrpbench_core.api import Bool, Float, Int, Int16, Int32, RobotModel
from mrpbench_core.model.common.geometry import segment_distance

NEAR_M = 0.1
"""Metres between two bodies below which they are close."""
PAUSE_S = 1.0
"""Seconds within which two robots that come close again are in the same near miss."""
ROWS = 1 << 14
"""Pairs of bodies that are compared at a time."""


def near_misses(
    time: Float, pose: Float, level: Int16, robots: Sequence[RobotModel], contact_time: Float, contact: Int32
) -> Float:
    """Return the times f8[k] at which near misses begin: two robots come close, and do not touch before they part.

    Robots that stand close at the beginning have no near miss until they part.

    Args:
        time: f8[T] seconds.
        pose: f8[T,n,3] x, y (metres), yaw (radians), in truth.
        level: i2[T,n].
        robots: their models, whose footprints count.
        contact_time: f8[c] seconds of contacts.
        contact: i4[c,2] the robots that touch then.
    """
    sample, one, other = _close_discs(pose, level, np.array([robot.radius for robot in robots]))
    close = _close_bodies(pose, robots, sample, one, other)
    sample, pair = sample[close], one[close] * len(robots) + other[close]
    touches = np.sort(contact, axis=1)
    found: list[float] = []
    for number in np.unique(pair).tolist():
        at = sample[pair == number]
        breaks = np.flatnonzero((np.diff(at) > 1) & (np.diff(time[at]) > PAUSE_S)) + 1
        touched = contact_time[(touches == divmod(number, len(robots))).all(axis=1)]
        for first, end in pairwise([0, *breaks.tolist(), len(at)]):
            begin, last = time[at[first]], time[at[end - 1]]
            is_contact = ((touched >= begin - PAUSE_S) & (touched <= last + PAUSE_S)).any()
            if at[first] > 0 and not is_contact:
                found.append(float(begin))
    return np.array(sorted(found))


def _close_discs(pose: Float, level: Int16, radii: Float) -> tuple[Int, Int, Int]:
    """Samples and pairs of robots i8[k] each, the lower index first, of which the circumscribed discs are close."""
    order = np.argsort(pose[..., 0], axis=1, kind="stable")
    x: Float = np.take_along_axis(pose[..., 0], order, axis=1)
    y: Float = np.take_along_axis(pose[..., 1], order, axis=1)
    on: Int16 = np.take_along_axis(level, order, axis=1)
    radius, reach = radii[order], 2 * float(radii.max(initial=0.0)) + NEAR_M
    found = [(np.empty(0, np.int64),) * 3]
    for apart in range(1, pose.shape[1]):
        dx = x[:, apart:] - x[:, :-apart]
        if dx.min(initial=np.inf) >= reach:
            break
        gap = np.hypot(dx, y[:, apart:] - y[:, :-apart]) - radius[:, apart:] - radius[:, :-apart]
        sample, row = np.nonzero((gap < NEAR_M) & (on[:, apart:] == on[:, :-apart]))
        found.append((sample, order[sample, row], order[sample, row + apart]))
    sample, one, other = (np.concatenate(column) for column in zip(*found, strict=True))
    by_time = np.argsort(sample, kind="stable")
    return sample[by_time], np.minimum(one, other)[by_time], np.maximum(one, other)[by_time]


def _close_bodies(pose: Float, robots: Sequence[RobotModel], sample: Int, one: Int, other: Int) -> Bool:
    """Tell bool[k] of which pairs of robots the footprints are close."""
    corners = max((len(robot.footprint) for robot in robots), default=0)
    padded = [np.pad(robot.footprint, ((0, corners - len(robot.footprint)), (0, 0)), "edge") for robot in robots]
    footprint = np.array(padded)

    def sides(robot: Int, rows: slice) -> tuple[Float, Float]:
        at, body = pose[sample[rows], robot[rows]], footprint[robot[rows]]
        cosine, sine = np.cos(at[:, 2:]), np.sin(at[:, 2:])
        x, y = body[..., 0], body[..., 1]
        placed = np.stack([at[:, :1] + cosine * x - sine * y, at[:, 1:2] + sine * x + cosine * y], axis=-1)
        return placed, np.roll(placed, -1, axis=1)

    close = np.zeros(len(sample), bool)
    for begin in range(0, len(sample), ROWS):
        rows = slice(begin, begin + ROWS)
        (a, b), (c, d) = sides(one, rows), sides(other, rows)
        gap = segment_distance(a[:, :, None], b[:, :, None], c[:, None], d[:, None])
        close[rows] = gap.min(axis=(1, 2)) < NEAR_M
    return close
