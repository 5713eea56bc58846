"""Progress of robots along their own paths, their arrivals, and when they are blocked."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.occupied import occupied


def under_way(run: FinishedRun) -> Bool:
    """bool[T,n]: whether a robot has not arrived yet at a sample; where tasks keep coming, whether it has a task."""
    if run.has("task_time"):
        return occupied(run)
    time = run.channel("time")
    return ~(time[:, None] >= arrival_times(run))  # true where NaN


def moves_among(segments: Int32, routes: Sequence[Route]) -> Int:
    """Number i8[T,n] of moves among the leading `segments` i4[T,n] of each robot's path."""
    moves = np.zeros(segments.shape, int)
    for robot, route in enumerate(routes):
        number = np.append(0, np.cumsum(route.is_move))
        moves[:, robot] = number[np.clip(segments[:, robot], 0, len(route.is_move))]
    return moves


def progress(truth: Float, reached: Int32, routes: Sequence[Route]) -> Float:
    """Metres f8[T,n] along each robot's path: the moves completed, and its true position projected on the next."""
    along, moves = np.empty(reached.shape), moves_among(reached, routes)
    for robot, route in enumerate(routes):
        point = route.waypoint[np.append(True, route.is_move), :2]
        span = np.diff(point, axis=0, append=point[-1:])  # the last waypoint has no next one
        length = np.hypot(span[:, 0], span[:, 1])
        done = moves[:, robot]
        offset = truth[:, robot, :2] - point[done]
        ahead = (offset * span[done]).sum(axis=1) / np.where(length > 0, length, 1.0)[done]
        begins = np.cumsum(length) - length
        along[:, robot] = begins[done] + np.clip(ahead, 0.0, length[done])
    return along


def blocked_intervals(time: Float, along: Float, going: Bool, window: float, distance: float) -> Bool:
    """bool[T,n]: whether the time since the previous sample counts as blocked for a robot.

    It does if, at the sample, the robot is under way, `window` seconds have passed since the start, and it has
    advanced less than `distance` metres in the last `window` seconds. Positions between samples are interpolated.
    """
    before = np.empty(along.shape)
    for robot in range(along.shape[1]):
        before[:, robot] = np.interp(time - window, time, along[:, robot])
    old_enough = time - time[0] >= window - 1e-9
    blocked: Bool = old_enough[:, None] & going & (along - before < distance)
    return blocked


def blocked_times(time: Float, along: Float, going: Bool, window: float, distance: float) -> Float:
    """Seconds f8[n] for which each robot is blocked."""
    spent = np.diff(time, prepend=time[0])
    blocked = blocked_intervals(time, along, going, window, distance)
    return np.array([spent[samples].sum() for samples in blocked.T], float)
