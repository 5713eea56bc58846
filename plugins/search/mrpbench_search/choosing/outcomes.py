"""Reads the outcomes of a setting from records: success and one metric, seed by seed."""

import numpy as np

from mrpbench_core.api.metric import Column
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.report.reading.runs import Runs
from mrpbench_search.choosing.candidates import Setting
from mrpbench_search.choosing.race import Outcomes


def outcomes(setting: Setting, runs: Runs, column: Column, seeds: int) -> Outcomes:
    """Return the outcomes of the first seeds, from the runs that have a record.

    Raises:
        InputError: candidates have different scenarios at a seed, so that nothing is paired.
    """
    place = {run_id: index for index, run_id in enumerate(runs.run_id)}
    success = np.full((len(setting.names), seeds), np.nan)
    values = success.copy()
    metric = runs.values.get(column.name, np.full(len(runs), np.nan)) * -direction(column)
    for at, seed in enumerate(setting.seeds[:seeds]):
        drawn = set()
        for candidate, points in enumerate(setting.points):
            indices = [place[point.run_id] for point in points[seed] if point.run_id in place]
            drawn |= {runs.scenario[index] for index in indices if runs.scenario[index] >= 0}
            counted = [index for index in indices if runs.counted[index]]
            success[candidate, at] = _mean(runs.values["succeeded"][counted])
            values[candidate, at] = _mean(metric[[index for index in counted if runs.values["succeeded"][index]]])
        if len(drawn) > 1:
            raise InputError(
                f"candidates have different scenarios with seed {seed}, so that nothing is paired",
                hint="--candidates names options that do not change starts and goals",
            )
    return Outcomes(success=success, values=values)


def _mean(values: Float) -> float:
    known = values[np.isfinite(values)]
    return float(known.mean()) if len(known) else np.nan
