"""How often robots stop on their way, and how long they stand."""

import math
from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.arrays import Bool
from mrpbench_core.model.run import FinishedRun
from mrpbench_metrics_standard.motion import steps, turns
from mrpbench_metrics_standard.progress import arrival_times, under_way
from mrpbench_metrics_standard.samples import measurable, nulls
from mrpbench_metrics_standard.spells import spells

_POSITIVE = attrs.validators.gt(0)


@attrs.frozen(kw_only=True)
class Stops(Metric):
    """Measures standing: from one sample to the next, both the mean speed and the mean turn rate are below limits.

    Only the time before a robot completes its path counts. Who turns on the spot does not stand.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "count",
            "",
            "lower",
            "sum over robots of the times they stood for at least `least` without a break, after having moved and "
            "before completing their path; planned waits count",
        ),
        Column("standing_s", "s", "lower", "sum over robots of the time standing before completing their path"),
        Column("standing_max_s", "s", "lower", "the largest of the robots' times standing"),
        Column(
            "standing_released_s",
            "s",
            "lower",
            "the part of standing_s in which the robot was allowed a further segment of its path: at the sample "
            "before, more segments were released than completed",
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
        going = under_way(time, arrival_times(time, reached, run.context.routes))[:-1]
        standing: Bool = still & going
        moved = np.logical_or.accumulate(going & ~still, axis=0)
        _, first, after = spells(standing & moved)
        lasted = np.where(standing, spent, 0.0)
        each = [math.fsum(own) for own in lasted.T]
        released = None
        if run.has("released"):
            released = math.fsum(lasted[(run.channel("released") > reached)[:-1]])
        return {
            "count": int((time[after] - time[first] >= self.least - 1e-9).sum()),
            "standing_s": math.fsum(each),
            "standing_max_s": max(each, default=0.0),
            "standing_released_s": released,
        }
