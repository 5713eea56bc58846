"""The column by which candidates are compared."""

from mrpbench_core.api.metric import Column
from mrpbench_core.engine.loading.runs import StudyRuns
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.report.reading.columns import describe_columns, direction

DEFAULT_METRICS = ("tasks.per_hour", "execution.duration_s", "planning.sum_of_costs")
"""Candidates are compared by the first of these that the study measures and that its runs can have."""


def metric_of(study: StudyRuns, name: str | None, option: str = "--metric") -> Column:
    """Return a column of a study, the default one if it is not named.

    Args:
        study: that measures it.
        name: of the column.
        option: of the command line, for errors.

    Raises:
        InputError: the study has no such column, or neither more nor less of it is better.
    """
    known = describe_columns(study.columns)
    plans_only = all(point.canonical["simulator"] in (None, "none") for point in study.runs)
    if name is None:
        possible = DEFAULT_METRICS[-1:] if plans_only else DEFAULT_METRICS
        name = next((column for column in possible if column in study.columns), None)
        if name is None:
            raise InputError(
                f"{option}: the study measures none of {', '.join(possible)}", hint="name a column of its metrics"
            )
    if name not in known:
        raise InputError(f"{option} {name}: the study has no such column", hint=did_you_mean(name, list(known)))
    if not direction(known[name]):
        raise InputError(f"{option} {name}: neither more nor less of it is better")
    return known[name]
