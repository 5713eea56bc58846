"""Completes the record of a run with the facts that only the invoking process knows."""

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.job import Failure, JobOutcome
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.record import RunError, RunRecord, StoredRecord
from mrpbench_core.model.runs.status import RunStatus, Stage


def complete_record(point: StudyRun, attempt: int, outcome: JobOutcome, workers: int, invocation: str) -> StoredRecord:
    """The record to store of an outcome that is a record or a failure."""
    run = outcome.record or _of_failure(point.run_id, outcome.failure)
    run.timing["concurrent_workers"] = workers
    return StoredRecord(
        run=run,
        attempt=attempt,
        config=point.canonical,
        seed=point.canonical["seed"],
        repeat=point.canonical["repeat"],
        provenance={**point.code, "machine": outcome.machine or machine(), "live": point.live},
        invocation=invocation,
    )


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
