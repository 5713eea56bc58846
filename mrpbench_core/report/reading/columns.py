"""Describes the columns of numbers: unit, direction, meaning, and how reports show them."""

import logging
from collections.abc import Iterable, Mapping
from functools import cache, partial
from typing import Any, get_args

import numpy as np

from mrpbench_core.api.metric import Better, Column, ColumnStage, Drawn, Metric, Question
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.referee.measuring import describe
from mrpbench_core.report.reading.invocations import read_invocations
from mrpbench_core.report.reading.outcome import PENALTY
from mrpbench_core.report.reading.runs import PAR2
from mrpbench_core.store.results import Results

_LOG = logging.getLogger(__name__)

Columns = Mapping[str, Column]
"""Columns by full name, `<metric>.<column>`."""

SHOWN_IF_ANY = ("execution.wall_contacts",)
"""Columns that are worth a place only if a run has more than 0."""
_OUTCOME = partial(Column, unit="", better="higher", answers="arrival", threshold=0.05)
OUTCOME = (
    _OUTCOME(
        "succeeded",
        description="share of the runs that planned and arrived, or did tasks until the end, of all that count",
    ),
    _OUTCOME(
        "planned",
        description="share of the runs whose planner found a plan that keeps its promises",
        stage="planning",
    ),
)
_PENALISED = f"wall time of the planner's call, where a run without a plan counts {PENALTY:g} times its limit (PAR2)"
_cost = partial(Column, better="lower", stage="planning", answers="planning")
_time = partial(_cost, unit="s", threshold=0.1, threshold_share=0.1)
TIMING = (
    _time(
        "timing.planning_s",
        description="wall time of the planner's call; runs with a plan only",
        primary=True,
        drawn="cactus",
    ),
    _time(PAR2, description=_PENALISED, primary=True),
    _time("timing.planning_cpu_s", description="CPU time of the planner's call; runs with a plan only"),
    _cost(
        "timing.planning_peak_bytes",
        unit="B",
        description="memory that planning added; runs with a plan only",
        threshold=1e7,
        threshold_share=0.1,
    ),
    Column(
        "timing.real_time_factor",
        "",
        "higher",
        "simulated time over wall time of the execution",
        threshold=1.0,
        threshold_share=0.1,
    ),
    Column("timing.clock_bound", "", "lower", "a clock ended the planning", stage="planning", threshold=0.05),
)
"""The columns that the engine measures, in wall time. Metrics declare all other columns."""
_KNOWN = {column.name: column for column in (*OUTCOME, *TIMING)}


def read_columns(folders: Iterable[Results], names: Iterable[str] = ()) -> dict[str, Column]:
    """The columns that the folders' invocations declare, those of the engine, and the others in `names`, by name."""
    declared: dict[str, Any] = {}
    for invocation in read_invocations(folders):
        declared |= invocation.get("columns") or {}
    return describe_columns(declared, names)


def describe_columns(declared: Mapping[str, Any], names: Iterable[str] = ()) -> dict[str, Column]:
    """The columns that one invocation declares, those of the engine, and the others in `names`, by name.

    Invocations of older versions declare less, and merged folders may lack invocations: the installed metric of that
    name completes them. Where none is installed, a column is not primary, and has no unit if none is declared.
    """
    wanted = [name for name in dict.fromkeys([*declared, *names]) if name not in _KNOWN]
    incomplete = [name for name in wanted if "threshold" not in (declared.get(name) or ())]
    installed = _installed(dict.fromkeys(map(_metric_of, incomplete)))
    place = {name: number for number, name in enumerate([*declared, *installed])}
    wanted.sort(key=lambda name: place.get(name, len(place)))  # as declared, not as values happen to come
    return {name: _column(name, installed.get(name), declared.get(name)) for name in wanted} | _KNOWN


def primary_columns(known: Columns) -> list[Column]:
    """The columns that are shown by default: those of the planning, then those of the execution."""
    stages = get_args(ColumnStage)
    return sorted((column for column in known.values() if column.primary), key=lambda c: stages.index(c.stage))


def shown_columns(known: Columns, values: Mapping[str, Float]) -> list[Column]:
    """The primary columns, and those of `SHOWN_IF_ANY` of which a run has some."""
    more = (known[name] for name in SHOWN_IF_ANY if name in known and np.any(values.get(name, 0.0) > 0))
    return [*primary_columns(known), *more]


def direction(column: Column) -> int:
    """1 where more is better, -1 where less is, 0 where neither is known to be."""
    return {"lower": -1, "higher": 1}.get(column.better, 0)


def heading(column: Column) -> str:
    """Name and unit, or the name alone if it ends with the unit."""
    says_unit = not column.unit or column.name.endswith(f"_{column.unit}")
    return column.name if says_unit else f"{column.name} [{column.unit}]"


def _column(name: str, *declarations: Any) -> Column:
    """The column that declarations describe; later ones count more."""
    declared = {key: value for each in declarations if isinstance(each, dict) for key, value in each.items()}
    unit, better = _timing(name)
    aliases = declared.get("aliases")
    return Column(
        name,
        str(declared.get("unit") or unit),
        _one_of(Better, declared.get("better"), better),
        str(declared.get("description") or ""),
        primary=bool(declared.get("primary")),
        stage=_one_of(ColumnStage, declared.get("stage"), "execution"),
        drawn=_one_of(Drawn, declared.get("drawn"), "interval"),
        answers=_one_of(Question, declared.get("answers"), None),
        threshold=_at_least_0(declared.get("threshold"), None),
        threshold_share=_at_least_0(declared.get("threshold_share"), None) or 0.0,
        aliases=tuple(map(str, aliases)) if isinstance(aliases, list) else (),
    )


def _timing(name: str) -> tuple[str, Any]:
    """Unit and direction of a timing that another version measures, from the end of its name."""
    unit = {"s": "s", "bytes": "B"}.get(name.rpartition("_")[2], "") if name.startswith("timing.") else ""
    return unit, "lower" if unit else "neither"


def _one_of(options: Any, value: Any, otherwise: Any) -> Any:
    return value if value in get_args(options) else otherwise


def _at_least_0(value: Any, otherwise: Any) -> Any:
    return value if value is None or (isinstance(value, int | float) and value >= 0) else otherwise


def _metric_of(name: str) -> str:
    return name.partition(".")[0]


def _installed(metrics: Iterable[str]) -> dict[str, Any]:
    """The declarations of the installed ones of these metrics, by name of the column."""
    there = {provider.name for provider in providers(Metric.group)}
    columns: dict[str, Any] = {}
    with slots_of_this_process():  # one worker for all metrics
        for metric in filter(there.__contains__, metrics):
            try:
                columns |= _described(metric)
            except InputError as error:
                _LOG.warning("%s", error)
    return columns


@cache
def _described(metric: str) -> dict[str, Any]:
    """The declarations of an installed metric, which a command needs for several tables."""
    declared: dict[str, Any] = in_worker(f"the columns of {metric} are not described", declarations_of, metric)
    return declared


def declarations_of(metric: str) -> dict[str, Any]:
    """In a worker process: the declarations of the columns of an installed metric."""
    return describe({metric: Registry(Metric).get(metric)})  # type: ignore[type-abstract]
