"""The facts of a run on the page: identity, choices, numbers."""

from collections.abc import Mapping
from typing import Any

from mrpbench_core.api.metric import Column
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.report.reading.columns import Columns

STAGES = (
    "roadmap",
    "scenario",
    "assigner",
    "planner",
    "dispatcher",
    "navigator",
    "controller",
    "simulator",
    "localizer",
)
FEW = 2
"""Number of options up to which they are shown with the name of the component."""


def facts_of(record: Mapping[str, Any], columns: Columns, planner: str) -> dict[str, Any]:
    """Return the parts of a run's record that the page shows.

    Args:
        record: as in `mrpbench_core.store.results`.
        columns: those of its metrics and timing, as `mrpbench_core.report.reading.columns` describes them.
        planner: name of the planner on the page.
    """
    config = record.get("config") or {}
    named = {stage: _summary(config[stage]) for stage in STAGES if config.get(stage)} | {"planner": planner}
    return {
        "run_id": record["run_id"],
        "status": record["status"],
        "error": record.get("error"),
        "partial": record["status"] == RunStatus.UNKNOWN,
        "planner": planner,
        "choices": [*named.items(), *((key, str(record.get(key, ""))) for key in ("seed", "repeat"))],
        "metrics": [{"name": name, "value": value, **_facts(columns.get(name))} for name, value in numbers_of(record)],
        "config": config,
    }


def numbers_of(record: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """The metrics and timing of a record, by full name."""
    timing = {f"timing.{name}": value for name, value in (record.get("timing") or {}).items()}
    timing.pop("timing.planning_history", None)  # a curve, no number
    return [*(record.get("metrics") or {}).items(), *timing.items()]


def _facts(column: Column | None) -> dict[str, Any]:
    if column is None:
        return {"unit": "", "text": ""}
    shown = {"primary": column.stage} if column.primary else {}
    return {"unit": column.unit, "text": column.description} | shown


def _summary(block: Any) -> str:
    """Write a component with its plain options, if they are few: `lanes cell_size=0.4`."""
    if not isinstance(block, Mapping):
        return str(block)
    options = {key: value for key, value in block.items() if key != "plugin" and _is_plain(value)}
    words = [str(block.get("plugin", "")), *(f"{key}={value}" for key, value in options.items())]
    return " ".join(words if len(words) <= FEW + 1 else words[:1])


def _is_plain(value: Any) -> bool:
    return isinstance(value, str | int | float)
