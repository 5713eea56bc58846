"""How far robots have got along their own paths, when they arrive, and when they are blocked."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.arrays import Float, Int32
from mrpbench_core.model.execution import Route


def arrival_times(time: Float, reached: Int32, routes: Sequence[Route]) -> Float:
    """Time f8[n] of the first sample at which each robot has completed all segments of its path; NaN = never."""
    arrived = reached >= np.array([len(route.speed) for route in routes])
    return np.where(arrived.any(axis=0), time[arrived.argmax(axis=0)], np.nan)


def progress(truth: Float, reached: Int32, routes: Sequence[Route]) -> Float:
    """Metres f8[T,n] along each robot's path: the segments completed, and its true position projected on the next."""
    along = np.empty(reached.shape)
    for robot, route in enumerate(routes):
        point = route.waypoint[:, :2]
        span = np.diff(point, axis=0, append=point[-1:])  # after the last waypoint there is nowhere to go
        length = np.hypot(span[:, 0], span[:, 1])
        segment = np.clip(reached[:, robot], 0, len(point) - 1)
        offset = truth[:, robot, :2] - point[segment]
        ahead = (offset * span[segment]).sum(axis=1) / np.where(length > 0, length, 1.0)[segment]
        begins = np.cumsum(length) - length
        along[:, robot] = begins[segment] + np.clip(ahead, 0.0, length[segment])
    return along


def blocked_times(time: Float, along: Float, arrival: Float, window: float, distance: float) -> Float:
    """Seconds f8[n] for which each robot is blocked.

    The time between two samples counts when, at the later one, the robot has not arrived, `window` seconds have passed
    since the start, and it has advanced less than `distance` metres in the last `window` seconds. Positions between
    samples are interpolated.
    """
    spent = np.diff(time, prepend=time[0])
    old_enough = time - time[0] >= window - 1e-9
    blocked = np.empty(along.shape[1])
    for robot in range(along.shape[1]):
        advanced = along[:, robot] - np.interp(time - window, time, along[:, robot])
        under_way = ~(time >= arrival[robot])  # true for ever where the arrival is NaN
        blocked[robot] = spent[old_enough & under_way & (advanced < distance)].sum()
    return blocked
