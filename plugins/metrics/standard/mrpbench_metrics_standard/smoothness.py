"""Smoothness of the driven paths.

Angle over length and curvature after Heiden, Palmieri, Bruns, Arras, Sukhatme, Koenig, "Bench-MR: A Motion Planning
Benchmark for Wheeled Mobile Robots", IEEE Robotics and Automation Letters 2021; normalised jerk after Teulings,
Contreras-Vidal, Stelmach, Adler, "Parkinsonism Reduces Coordination of Fingers, Wrist, and Arm in Fine Motor Control",
Experimental Neurology 1997. The exact definitions, on samples, are those of the columns.
"""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.distribution import percentile
from mrpbench_metrics_standard.motion import steps, turns
from mrpbench_metrics_standard.samples import measurable, nulls

BENCH_MR = "after Heiden et al., Bench-MR, IEEE Robotics and Automation Letters 2021"
TEULINGS = "Teulings et al., Experimental Neurology 146, 1997"
_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Smoothness(Metric):
    """Measures the smoothness of true motion. Robots that drive less than `least` are left out.

    A robot moves from one sample to the next if its mean speed is at least `speed`.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "angle_over_length",
            "rad/m",
            "lower",
            "sum of all absolute changes of yaw between samples, divided by the distance driven; turns on the spot "
            "count",
            BENCH_MR,
        ),
        Column(
            "curvature_mean",
            "1/m",
            "lower",
            "the same, over the steps in which the robot moves only: mean curvature of the driven path",
            BENCH_MR,
        ),
        Column(
            "curvature_p95",
            "1/m",
            "lower",
            "95th percentile, over the steps between samples in which a robot moves, of the change of yaw divided by "
            "the length of the step",
            BENCH_MR,
        ),
        Column(
            "normalised_jerk",
            "",
            "lower",
            "median over robots of sqrt(1/2 * integral of squared jerk * duration^5 / length^2), from the first to the "
            "last move, with the jerk from differences of positions; 19 for the smoothest motion from rest to rest",
            TEULINGS,
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth"})

    speed: float = option(0.02, help="speed from which a robot moves", unit="m/s", validator=_POSITIVE)
    least: float = option(0.1, help="distance that a robot must drive to be measured", unit="m", validator=_POSITIVE)

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; null where no robot drove far enough."""
        if not measurable(self, run):
            return nulls(self)
        time, truth = _regular(run.channel("time"), run.channel("truth"))
        length = steps(truth)
        truth = truth[:, [math.fsum(column) >= self.least for column in length.T]]
        if not truth.size:
            return nulls(self)
        length, turned = steps(truth), turns(truth)
        moves = length >= self.speed * np.diff(time)[:, None]
        way = math.fsum(length[moves])
        jerks = [
            _normalised_jerk(time, track, column)
            for track, column in zip(np.moveaxis(truth, 1, 0), moves.T, strict=True)
        ]
        return {
            "angle_over_length": math.fsum(turned.ravel()) / math.fsum(length.ravel()),
            "curvature_mean": math.fsum(turned[moves]) / way if way else None,
            "curvature_p95": percentile(turned[moves] / length[moves], 95),
            "normalised_jerk": percentile(np.array([jerk for jerk in jerks if jerk is not None]), 50),
        }


def _regular(time: Float, truth: Float) -> tuple[Float, Float]:
    """Drop the last sample if it follows after half the usual time or less: such differences would be noise."""
    spent = np.diff(time)
    if len(spent) > 1 and spent[-1] < 0.51 * np.median(spent):
        return time[:-1], truth[:-1]
    return time, truth


def _normalised_jerk(time: Float, track: Float, moves: Bool) -> float | None:
    """Normalised jerk of a robot's poses `track` f8[T,3]; None if it never moves or has too few samples."""
    moving = np.flatnonzero(moves)
    if not len(moving) or len(time) < 4:
        return None
    begin, end = time[moving[0]], time[moving[-1] + 1]
    rate, stamp = track[:, :2], time
    for _ in range(3):
        rate = np.diff(rate, axis=0) / np.diff(stamp)[:, None]
        stamp = (stamp[1:] + stamp[:-1]) / 2
    within = (stamp >= begin) & (stamp <= end)
    spent = np.diff((time[:-1] + time[1:]) / 2)  # between mid-times, as long as a step; one fewer than those
    spent = (spent[1:] + spent[:-1]) / 2
    integral = math.fsum(((rate**2).sum(axis=1) * spent)[within])
    length = math.fsum(np.hypot(*np.diff(track[moving[0] : moving[-1] + 2, :2], axis=0).T))
    return math.sqrt(integral / 2 * float(end - begin) ** 5 / length**2)
