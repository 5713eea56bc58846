"""Completes the record of a run with what the invoking process knows."""

import functools
from pathlib import Path
from typing import Any

from mrpbench_core.api.component import Component
from mrpbench_core.config.study import RunPoint
from mrpbench_core.engine.processes.job import Failure, JobOutcome
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.study.versions import versions
from mrpbench_core.model.status import RunStatus, Stage
from mrpbench_core.plugins.provenance import components_in, origin


def complete_record(point: RunPoint, attempt: int, outcome: JobOutcome, workers: int) -> dict[str, Any]:
    """The record to store for an outcome that has one or is a failure."""
    made = outcome.record if outcome.record is not None else _of_failure(outcome.failure)
    live = any(component.live for component in components_in(point.config))
    record = {
        "run_id": point.run_id,
        "scenario_id": made.get("scenario_id"),
        "attempt": attempt,
        "config": point.canonical,
        "seed": point.config.seed,
        "repeat": point.config.repeat,
        "status": made["status"],
        "metrics": made["metrics"],
        "timing": {**made["timing"], "concurrent_workers": workers},
        "provenance": {**code_of(point), "machine": outcome.machine or machine(), "live": live},
    }
    for key in ("unmeasured", "unexported", "reassigned", "error"):
        if made.get(key):
            record[key] = made[key]
    return record


def code_of(point: RunPoint) -> dict[str, Any]:
    """The code that a run would be made with now."""
    return _code(tuple(dict.fromkeys(map(type, components_in(point.config)))), point.folder)


@functools.lru_cache(maxsize=256)
def _code(classes: tuple[type[Component], ...], folder: Path) -> dict[str, Any]:
    components = [origin(cls, folder) for cls in classes]
    for entry in components:  # where a checkout lies says nothing about the code
        entry.pop("direct_url", None)
    return {"components": components, "versions": versions(components)}


def _of_failure(failure: Failure | None) -> dict[str, Any]:
    assert failure is not None
    planning = failure.stage == Stage.PLANNING
    return {
        "scenario_id": failure.scenario_id,
        "status": failure.status,
        "metrics": {},
        "timing": {"planning_s": failure.seconds, "clock_bound": failure.status == RunStatus.PLAN_TIMEOUT}
        if planning
        else {},
        "error": {"stage": failure.stage, "message": failure.message},
    }
