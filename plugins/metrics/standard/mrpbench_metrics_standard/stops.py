"""Stops of robots before they arrive, and the time that they stand."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.common.intervals import runs
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.motion import steps, turns
from mrpbench_metrics_standard.progress import moves_among, under_way
from mrpbench_metrics_standard.samples import measurable, nulls

_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Stops(Metric):
    """Measures standing: a robot stands if its mean speed and mean turn rate between two samples are below limits.

    Only the time before a robot completes its path counts. A robot that turns on the spot does not stand.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "count",
            "",
            "lower",
            "sum over robots of the number of periods of at least `least` in which they stand without interruption, "
            "after their first move and before they complete their path; planned waits count",
        ),
        Column(
            "standing_s", "s", "lower", "sum over robots of the time that they stand before they complete their path"
        ),
        Column("standing_max_s", "s", "lower", "the longest time that a single robot stands"),
        Column(
            "standing_released_s",
            "s",
            "lower",
            "the part of standing_s in which the robot may drive on: at the previous sample, more moves of its path "
            "were released than completed",
            requires=frozenset({"released"}),
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "truth", "reached"})

    speed: float = option(0.02, help="speed below which a robot stands", unit="m/s", validator=_POSITIVE)
    turn_rate: float = option(0.05, help="turn rate below which a robot stands", unit="rad/s", validator=_POSITIVE)
    least: float = option(0.5, help="time for which a robot must stand to have stopped", unit="s", validator=_POSITIVE)

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        time, truth, reached = run.channel("time"), run.channel("truth"), run.channel("reached")
        spent = np.diff(time)[:, None]
        still = (steps(truth) < self.speed * spent) & (turns(truth) < self.turn_rate * spent)
        going = under_way(run)[:-1]
        standing: Bool = still & going
        moved = np.logical_or.accumulate(going & ~still, axis=0)
        _, first, after = runs((standing & moved).T)
        lasted = np.where(standing, spent, 0.0)
        each = [math.fsum(column) for column in lasted.T]
        released = None
        if run.has("released"):
            routes = run.context.routes
            may_drive = moves_among(run.channel("released"), routes) > moves_among(reached, routes)
            released = math.fsum(lasted[may_drive[:-1]])
        return {
            "count": int((time[after] - time[first] >= self.least - 1e-9).sum()),
            "standing_s": math.fsum(each),
            "standing_max_s": max(each, default=0.0),
            "standing_released_s": released,
        }
