"""Contract of the kind *metric*."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar, Literal

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.model.run import FinishedRun

Value = float | int | bool | None
"""None = not measurable for this run, with the reason in `Measurement.reasons`."""


@attrs.frozen
class Column:
    """One number a metric gives."""

    name: str
    unit: str
    """SI unit, or '' for a count or ratio."""
    better: Literal["lower", "higher", "neither"]
    description: str
    source: str = ""
    """Paper or standard that defines it."""
    requires: frozenset[str] = frozenset()
    """What this number needs beside `Metric.requires`; where it is missing, only this column is null. Recordings of
    real fleets lack what only a simulator knows."""


class Metric(Component):
    """Measures a finished run from its plan and recording."""

    group: ClassVar[str] = "mrpbench.metrics"
    columns: ClassVar[tuple[Column, ...]]
    requires: ClassVar[frozenset[str]] = frozenset()
    """Channels of the recording, `plan`, and `path` (the paths that robots were to follow are known). Where one is
    missing, every column is null with that reason, never 0."""

    @abstractmethod
    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return a value for each column, by name."""
