"""Runs settings of parameters on seeds, and reads the columns that matter."""

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.reading.runs import read_runs
from mrpbench_search.asking.requests import Requests
from mrpbench_search.asking.variants import read_variants

Setting = Mapping[str, Any]
"""Values by option; options that are not named have those of the study."""
Sample = tuple[int, int]
"""Seed and repeat."""


@attrs.frozen(kw_only=True)
class Evaluated:
    """The columns of one setting, sample by sample."""

    columns: Mapping[str, Float]
    """f8[k], NaN = not measured; `succeeded` is 0 or 1."""
    ids: tuple[str, ...]
    """Of the runs."""

    def mean(self, column: str) -> float:
        """Return the mean over the samples that have a value; NaN if none has."""
        values = self.columns[column]
        known = values[np.isfinite(values)]
        return float(known.mean()) if len(known) else np.nan

    def first(self, count: int) -> "Evaluated":
        """Return what the first samples show."""
        return Evaluated(columns={name: values[:count] for name, values in self.columns.items()}, ids=self.ids[:count])

    def same(self, other: "Evaluated") -> bool:
        """Tell whether all columns have the same values in both."""
        return all(np.array_equal(values, other.columns[name], equal_nan=True) for name, values in self.columns.items())


@attrs.frozen(kw_only=True)
class Evaluation:
    """Does the runs of a tuning."""

    study: StudyRuns
    point: StudyRun
    """The run that settings change."""
    columns: tuple[str, ...]
    requests: Requests

    def __call__(self, settings: Sequence[Setting], samples: Sequence[Sample]) -> list[Evaluated]:
        """Return what each setting gives on some samples.

        Raises:
            SearchEnded: as of `Requests.results`.
            InputErrors: a value is refused.
        """
        changes = [{**setting, "seed": seed, "repeat": repeat} for setting in settings for seed, repeat in samples]
        labels = [{**setting, "seed": seed} for setting in settings for seed, _ in samples]
        study = read_variants(self.study, self.point, changes, labels)
        results = self.requests.results(study, study.runs)
        runs = read_runs([results])
        place = {run_id: index for index, run_id in enumerate(runs.run_id)}
        ids = [point.run_id for point in study.runs]
        rows = np.array([place[run_id] for run_id in ids])
        succeeded = np.where(runs.counted[rows], runs.values["succeeded"][rows], np.nan)
        found = {"succeeded": succeeded}
        for name in self.columns:
            values = runs.values.get(name, np.full(len(runs), np.nan))[rows]
            found[name] = np.where(succeeded == 1, values, np.nan)
        size = len(samples)
        parts = [slice(first, first + size) for first in range(0, len(rows), size)]
        return [
            Evaluated(columns={name: values[part] for name, values in found.items()}, ids=tuple(ids[part]))
            for part in parts
        ]
