"""Distances of robots from the released parts of their paths."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import mean, percentile
from mrpbench_metrics_standard.progress import under_way
from mrpbench_metrics_standard.samples import measurable, nulls

_SCOPE = (
    "over all samples of robots that have not completed their path, of the distance of the true position from the "
    "nearest point of the path, from the start of the last completed move to the end of the next but one, as far as "
    "released"
)


@attrs.frozen(kw_only=True)
class Tracking(Metric):
    """Measures the cross-track error: the distance of the true position from the current part of the path.

    Only the neighbouring moves count, so that other parts of the path, which may be close, do not hide an error. Errors
    of localisation and control add up. Each sample has the same weight.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("mean_m", "m", "lower", f"mean {_SCOPE}"),
        Column("p95_m", "m", "lower", f"95th percentile {_SCOPE}"),
        Column("max_m", "m", "lower", f"largest value {_SCOPE}"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "reached", "released", "path"})

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where every robot had arrived from the start."""
        if not measurable(self, run):
            return nulls(self)
        truth, reached = run.channel("truth"), run.channel("reached")
        routes, released = run.context.routes, run.channel("released")
        going = under_way(run)
        errors = [np.empty(0)]
        for robot, route in enumerate(routes):
            rows = going[:, robot]
            position, known = truth[rows, robot, :2], (reached[rows, robot], released[rows, robot])
            errors.append(_cross_track(route.waypoint[:, :2], position, *known))
        error = np.concatenate(errors)
        return {"mean_m": mean(error), "p95_m": percentile(error, 95), "max_m": percentile(error, 100)}


def _cross_track(waypoint: Float, position: Float, reached: Int, released: Int) -> Float:
    """Metres f8[T] of `position` f8[T,2] from the current part of the path, which has no waits."""
    moves = (np.diff(waypoint, axis=0) != 0).any(axis=1)
    corner = waypoint[np.append(True, moves)]
    number = np.append(0, np.cumsum(moves))  # of moves among so many leading segments
    most = len(number) - 1
    done = number[np.clip(reached, 0, most)]
    allowed = np.maximum(number[np.clip(released, 0, most)], done)
    nearest: Float = np.hypot(*(position - corner[done]).T)
    for offset in (-1, 0, 1):
        move = done + offset
        known = np.flatnonzero((move >= 0) & (move < allowed))
        gap = point_segment_distance(position[known], corner[move[known]], corner[move[known] + 1])
        nearest[known] = np.minimum(nearest[known], gap)
    return nearest
