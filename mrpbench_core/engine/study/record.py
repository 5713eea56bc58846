"""Completes the record of a run with the facts that only the invoking process knows."""

import functools
from pathlib import Path
from typing import Any

from mrpbench_core.api.component import Component
from mrpbench_core.config.study import RunPoint
from mrpbench_core.engine.processes.job import Failure, JobOutcome
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.record import RunError, RunRecord, StoredRecord
from mrpbench_core.engine.study.versions import versions
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.provenance import components_in, origin


def complete_record(point: RunPoint, attempt: int, outcome: JobOutcome, workers: int) -> StoredRecord:
    """The record to store of an outcome that is a record or a failure."""
    run = outcome.record or _of_failure(point.run_id, outcome.failure)
    run.timing["concurrent_workers"] = workers
    live = any(component.live for component in components_in(point.config))
    return StoredRecord(
        run=run,
        attempt=attempt,
        config=point.canonical,
        seed=point.config.seed,
        repeat=point.config.repeat,
        provenance={**code_of(point), "machine": outcome.machine or machine(), "live": live},
    )


def code_of(point: RunPoint) -> dict[str, Any]:
    """The components and versions that a run would be made with now."""
    return _code(tuple(dict.fromkeys(map(type, components_in(point.config)))), point.folder)


@functools.lru_cache(maxsize=256)
def _code(classes: tuple[type[Component], ...], folder: Path) -> dict[str, Any]:
    components = [origin(cls, folder) for cls in classes]
    for entry in components:  # the place of a checkout says nothing about the code
        entry.pop("direct_url", None)
    return {"components": components, "versions": versions(components)}


def _of_failure(run_id: str, failure: Failure | None) -> RunRecord:
    assert failure is not None
    record = RunRecord(
        run_id=run_id,
        scenario_id=failure.scenario_id,
        status=failure.status,
        error=RunError(stage=failure.stage, message=failure.message),
    )
    if failure.stage == Stage.PLANNING:
        late = failure.status == RunStatus.PLAN_TIMEOUT
        record.timing |= {"planning_s": failure.seconds, "clock_bound": late}
    return record
