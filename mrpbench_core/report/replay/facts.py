"""What the page says about a run: identity, choices, figures."""

from collections.abc import Mapping
from typing import Any

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
"""Options of a stage up to which they are shown beside its name."""


def facts_of(record: Mapping[str, Any], columns: Mapping[str, Any], planner: str) -> dict[str, Any]:
    """The parts of a run's record that the page shows.

    Args:
        record: as in `mrpbench_core.store.results`.
        columns: unit, direction and description of metrics, as an invocation keeps them.
        planner: what to call the planner.
    """
    config = record.get("config") or {}
    named = {stage: _summary(config[stage]) for stage in STAGES if config.get(stage)} | {"planner": planner}
    return {
        "run_id": record["run_id"],
        "status": record["status"],
        "error": record.get("error"),
        "planner": planner,
        "choices": [*named.items(), *((key, str(record.get(key, ""))) for key in ("seed", "repeat"))],
        "metrics": [
            {"name": name, "value": value, **_column(columns.get(name))}
            for name, value in (record.get("metrics") or {}).items()
        ]
        + [
            {"name": f"timing.{name}", "value": value, **_timing(name)}
            for name, value in (record.get("timing") or {}).items()
            if name != "planning_history"  # a curve, no figure
        ],
        "config": config,
    }


def _column(column: Any) -> dict[str, str]:
    found = column or {}
    return {"unit": found.get("unit") or "", "text": found.get("description") or ""}


def _timing(name: str) -> dict[str, str]:
    unit = {"s": "s", "bytes": "B"}.get(name.rpartition("_")[2], "")
    return {"unit": unit, "text": ""}


def _summary(block: Any) -> str:
    """`lanes cell_size=0.4`: a component, and its plain options if they are few."""
    if not isinstance(block, Mapping):
        return str(block)
    options = {key: value for key, value in block.items() if key != "plugin" and _is_plain(value)}
    words = [str(block.get("plugin", "")), *(f"{key}={value}" for key, value in options.items())]
    return " ".join(words if len(words) <= FEW + 1 else words[:1])


def _is_plain(value: Any) -> bool:
    return isinstance(value, str | int | float)
