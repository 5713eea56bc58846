"""Contract of the kind *metric*."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar, Literal

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.model.runs.run import FinishedRun

Value = float | int | bool | None
"""None means that the run does not allow the measurement; `unmeasured` in its record gives the reason."""

Better = Literal["lower", "higher", "neither"]
ColumnStage = Literal["planning", "execution"]
Drawn = Literal["interval", "profile", "cactus"]
Question = Literal["throughput", "service", "queue", "arrival", "duration", "planning", "proximity"]


@attrs.frozen
class Column:
    """One number that a metric gives, and how reports show it.

    Results folders keep these facts (`invocations/<id>.yaml`), so that a report needs no plugin to show its columns.
    """

    name: str
    """Name within the metric; in records and reports `<metric>.<column>`."""
    unit: str
    """SI unit, or '' for a count or ratio."""
    better: Better
    description: str
    source: str = ""
    """Paper or standard that defines it."""
    requires: frozenset[str] = frozenset()
    """The data that this number needs in addition to `Metric.requires`. If they are missing, only this column is null;
    recordings of real fleets lack data that only a simulator has."""
    primary: bool = False
    """True if tables, figures, summaries and replays show it unless the user selects columns."""
    stage: ColumnStage = "execution"
    """The stage that it measures. Figures that count runs without a value as failures use the runs that have a plan, or
    the runs that succeeded."""
    drawn: Drawn = "interval"
    """The figures of a primary column: its mean with an interval; also a performance profile (Dolan and Moré 2002); or
    also a profile and a cactus plot, on a logarithmic axis. The last two are for values above 0 of which less is
    better."""
    answers: Question | None = None
    """The question at the beginning of a report that it helps to answer: how much gets done, how long does a task take,
    how many tasks are open, do robots arrive, how long do they take, how long does planning take, how near do they get?
    None = a question of its own, if it is shown."""
    threshold: float | None = None
    """Smallest difference of two means, in `unit`, that matters in practice (smallest effect size of interest;
    D. Lakens, "Equivalence Tests", Social Psychological and Personality Science 8, 2017). Reports call no smaller
    difference noticeable, and none at all if it is None."""
    threshold_share: float = 0.0
    """The same as a share of the larger mean; a noticeable difference reaches both thresholds."""
    aliases: tuple[str, ...] = ()
    """Full names (`<metric>.<column>`) under which older records hold the same number; reports read them as this."""


class Metric(Component):
    """Measures a finished run from its plan and recording."""

    group: ClassVar[str] = "mrpbench.metrics"
    reserved: ClassVar[frozenset[str]] = frozenset({"analysis", "config", "error", "plan", "provenance", "timing"})
    """The parts of a record, with which the columns of a metric of that name would be mistaken."""
    columns: ClassVar[tuple[Column, ...]]
    requires: ClassVar[frozenset[str]] = frozenset()
    """Channels of the recording, `plan`, and `path` (the paths that robots were to follow are known). Where one is
    missing, every column is null with that reason, never 0."""

    @abstractmethod
    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return a value for each column, by name; None where it cannot be measured.

        No value depends on the order of the robots.
        """
