"""The execution metrics of the original MRP-Bench, by the definitions of its analyser.

Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered Environments", 2023. It reads
messages with all robots' positions, 2 Hz, and measures straight-line distances to starts and goals. One thing differs:
messages carry simulated time here, and wall time in the original.
"""

import math

import numpy as np

from mrpbench_core.api import Column, Value
from mrpbench_core.model.common.arrays import Bool, Float, Int

RATE = 2.0
"""Hz of messages."""
WINDOW = 10
"""Number of distances from which it follows whether a robot is blocked."""

SOURCE = "Schaefer et al., A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered Environments, 2023"
END = frozenset({"end"})

COLUMNS = (
    Column(
        "mrp_bench.success",
        "",
        "higher",
        "every robot has been within `mrp_bench_tolerance` of its goal",
        SOURCE,
        requires=END,
    ),
    Column(
        "mrp_bench.duration_s",
        "s",
        "lower",
        "time from the first message in which a robot is farther than the tolerance from its start to the message in "
        "which the last robot has been within the tolerance of its goal; `mrp_bench_timeout` if a robot never is; null "
        "if no robot left its start",
        SOURCE,
        requires=END,
    ),
    Column(
        "mrp_bench.goals_reached",
        "",
        "higher",
        "number of robots that have been within the tolerance of their goal",
        SOURCE,
        requires=END,
    ),
    Column("mrp_bench.min_distance_m", "m", "higher", "smallest distance between the centres of two robots", SOURCE),
    Column("mrp_bench.min_distance_at_start_m", "m", "higher", "the same distance in the first message", SOURCE),
    Column("mrp_bench.min_distance_delta_m", "m", "lower", "min_distance_at_start_m - min_distance_m", SOURCE),
    Column(
        "mrp_bench.time_blocked_s",
        "s",
        "lower",
        "number of messages in which a robot is blocked, times their mean period; of a robot that has not reached its "
        "goal, the messages count in which it is more than a cell from its start or less than a cell from its goal; it "
        "is blocked if its distance to the goal differs by at most a cell from the oldest of the last ten such "
        "messages",
        SOURCE,
        requires=END,
    ),
    Column(
        "mrp_bench.time_blocked_max_s",
        "s",
        "lower",
        "the largest blocked time of a single robot",
        SOURCE,
        requires=END,
    ),
)


def measure_as_original(
    time: Float, position: Float, start: Float, goal: Float, tolerance: float, cell_size: float, timeout: float
) -> dict[str, Value]:
    """All of `COLUMNS`, from samples `position` f8[T,n,2] at `time` f8[T], and starts and goals f8[n,2]."""
    message = _messages(time)
    stamp, position = time[message], position[message]
    to_start, to_goal = (np.linalg.norm(position - place, axis=-1) for place in (start, goal))
    at_goal = np.logical_or.accumulate(to_goal < tolerance, axis=0)
    away = (to_start > tolerance).any(axis=1)
    period = (stamp[-1] - stamp[0]) / len(stamp)
    counts = ~at_goal & ((to_start > cell_size) | (to_goal < cell_size))
    blocked = np.array([_blocked(to_goal[counts[:, robot], robot], cell_size) for robot in range(len(goal))]) * period
    gaps = _pair_distances(position)
    values: dict[str, Value] = {
        "success": bool(at_goal[-1].all()),
        "duration_s": _duration(stamp, at_goal, away, timeout),
        "goals_reached": int(at_goal[-1].sum()),
        "time_blocked_s": math.fsum(blocked),
        "time_blocked_max_s": float(blocked.max(initial=0.0)),
        "min_distance_m": None,
        "min_distance_at_start_m": None,
        "min_distance_delta_m": None,
    }
    if gaps is not None:
        least, first = float(gaps.min()), float(gaps[0])
        values |= {"min_distance_m": least, "min_distance_at_start_m": first, "min_distance_delta_m": first - least}
    return {f"mrp_bench.{name}": value for name, value in values.items()}


def _messages(time: Float) -> Int:
    """Index of the newest sample at each message, whose state it carries. The last sample is a message, too."""
    stamps = time[0] + np.arange(int((time[-1] - time[0]) * RATE + 1e-6) + 1) / RATE
    newest = np.searchsorted(time, stamps + 1e-6, side="right") - 1
    return np.unique(np.append(newest, len(time) - 1))


def _duration(stamp: Float, at_goal: Bool, away: Bool, timeout: float) -> float | None:
    if not at_goal[-1].all():
        return timeout
    last = int(at_goal.all(axis=1).argmax())
    if not away[: last + 1].any():
        return None
    return float(stamp[last] - stamp[away.argmax()])


def _blocked(to_goal: Float, cell_size: float) -> int:
    """Count the samples at which the distance to the goal is about the same as ten samples (nine periods) before."""
    oldest, newest = to_goal[: -(WINDOW - 1)], to_goal[WINDOW - 1 :]
    return int((np.abs(oldest - newest) <= cell_size).sum())


def _pair_distances(position: Float) -> Float | None:
    """Smallest distance f8[T] between two robots in each message, on any levels; None for fewer than two robots."""
    count = position.shape[1]
    if count < 2:
        return None
    least = np.full(len(position), np.inf)
    for robot in range(count - 1):
        gap = np.linalg.norm(position[:, robot + 1 :] - position[:, [robot]], axis=-1)
        least = np.minimum(least, gap.min(axis=1))
    return least
