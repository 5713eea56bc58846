"""The durations and the first times of contacts. The metric `execution` counts contacts."""

from collections.abc import Mapping
from typing import Any, ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.samples import measurable, nulls

PAUSE = 1.0


def _is_default(_instance: Any, _field: Any, value: float) -> None:
    if value != PAUSE:
        raise ValueError("the metric `execution` counts contacts now: set its option `contact_pause` instead")


@attrs.frozen(kw_only=True)
class Contact(Metric):
    """Measures how long robots touch, as the simulator reports it: one touch per pair and control period.

    `execution` counts the episodes of contact: `execution.robot_contacts` and `execution.wall_contacts`.
    """

    columns: ClassVar[tuple[Column, ...]] = (
        Column("robot_time_s", "s", "lower", "sum over pairs of robots of the control periods in which they touch"),
        Column("wall_time_s", "s", "lower", "sum over robots of the control periods in which they touch a wall"),
        Column("robots_touched", "", "lower", "robots that touched anything"),
        Column("first_s", "s", "higher", "time from the start until the first touch; null if there is none"),
        Column(
            "force_max_n",
            "N",
            "lower",
            "largest normal force of a touch, its mean over a control period; null if the simulator does not know it",
        ),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "contact_time", "contact"})

    pause: float = option(
        PAUSE,
        help="kept for older configurations, with its default only: `contact_pause` of `execution` replaces it",
        unit="s",
        validator=_is_default,
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        stamp, pair = run.channel("contact_time"), run.channel("contact")
        among_robots = pair[:, 1] < len(run.context.fleet)  # the metric `people` measures contacts with movers
        force = run.channel("contact_force")[among_robots] if run.has("contact_force") else np.empty(0)
        stamp, pair = stamp[among_robots], pair[among_robots]
        wall = int((pair < 0).any(axis=1).sum())
        return {
            "robot_time_s": (len(pair) - wall) * run.context.period,
            "wall_time_s": wall * run.context.period,
            "robots_touched": len(np.unique(pair[pair >= 0])),
            "first_s": float(stamp.min() - run.channel("time")[0]) if len(stamp) else None,
            "force_max_n": float(np.nanmax(force)) if np.isfinite(force).any() else None,
        }
