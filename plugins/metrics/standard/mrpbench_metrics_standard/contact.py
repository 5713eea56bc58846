"""How often, how long and how early robots touch."""

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value, option
from mrpbench_core.model.run import FinishedRun
from mrpbench_metrics_standard.contacts import episodes
from mrpbench_metrics_standard.samples import measurable, nulls


@attrs.frozen(kw_only=True)
class Contact(Metric):
    """Measures touches of surfaces as the simulator reports them, one per pair and control period."""

    columns: ClassVar[tuple[Column, ...]] = (
        Column(
            "robot_count",
            "",
            "lower",
            "episodes of two robots touching; touches of a pair at most `pause` apart are one episode",
        ),
        Column("robot_time_s", "s", "lower", "sum over pairs of robots of the control periods in which they touch"),
        Column("wall_count", "", "lower", "episodes of a robot touching a wall or obstacle, counted likewise"),
        Column("wall_time_s", "s", "lower", "sum over robots of the control periods in which they touch a wall"),
        Column("robots_touched", "", "lower", "robots that touched anything"),
        Column("first_s", "s", "higher", "from the start until the first touch; null if there is none"),
    )
    requires: ClassVar[frozenset[str]] = frozenset({"time", "contact_time", "contact"})

    pause: float = option(
        1.0, help="time without touching that ends an episode", unit="s", validator=attrs.validators.gt(0)
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns."""
        if not measurable(self, run):
            return nulls(self)
        stamp, pair = run.channel("contact_time"), run.channel("contact")
        robots, walls = episodes(stamp, pair, self.pause)
        wall = int((pair < 0).any(axis=1).sum())
        return {
            "robot_count": robots,
            "robot_time_s": (len(pair) - wall) * run.context.period,
            "wall_count": walls,
            "wall_time_s": wall * run.context.period,
            "robots_touched": len(np.unique(pair[pair >= 0])),
            "first_s": float(stamp.min() - run.channel("time")[0]) if len(stamp) else None,
        }
