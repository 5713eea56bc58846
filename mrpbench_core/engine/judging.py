"""Makes the record of a run from its verdict and the claims of its process."""

from collections.abc import Mapping
from contextlib import closing
from typing import Any

import attrs

from mrpbench_core.api.metric import Metric
from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.engine.drive.drive import Claims
from mrpbench_core.engine.record import RunError, RunRecord
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.printing import printable
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.verdict import Failure, Verdict, broken, judge
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.run_files import seal

UNRECORDED = RunStatus.SKIPPED, RunStatus.CONTRACT_BROKEN
"""How a run without a recording can have ended."""


@attrs.frozen(kw_only=True)
class Prepared:
    """The instance of a run, and what was found while it was made."""

    scenario_id: str
    instance: str
    """Its name in the folder of instances."""
    reassigned: int = 0
    """The number of robots whose goal is not the one that the scenario gives them."""
    timing: dict[str, Any] = attrs.field(factory=dict)


def record_of(
    asked: Asked,
    prepared: Prepared,
    claims: Claims,
    paths: RunPaths,
    metrics: Mapping[str, Metric],
    instances: InstanceFolder,
    source: TaskSource | None,
) -> RunRecord:
    """Judge a run, and return its record.

    Args:
        asked: of the run.
        prepared: its instance.
        claims: of the process in which it ran.
        paths: with its recording, unless it ended before.
        metrics: to measure, of this project only.
        instances: the folder with the instance.
        source: of its tasks, if they come over time.

    Raises:
        OSError: a file cannot be read or written.
    """
    record = RunRecord(
        run_id=asked.run_id,
        scenario_id=prepared.scenario_id,
        reassigned=prepared.reassigned,
        timing=prepared.timing | claims.timing,
        unexported=claims.unexported,
        unarrived=claims.unarrived,
    )
    verdict = Verdict(failure=claims.failure)
    if claims.recorded:
        try:
            recording = Recording(paths.recording, instances)
        except InputError as error:
            verdict = broken(f"the recording was damaged: {error.message}")
        else:
            with closing(recording):
                verdict = judge(asked, recording, prepared.instance, metrics, claims.failure, source)
                record.executed = asked.executes and "time" in recording.channels
    else:
        paths.recording.unlink(missing_ok=True)  # which has no verdict
        if claims.failure is None or claims.failure.status not in UNRECORDED:
            verdict = broken("nothing was recorded")
    if record.executed:
        record.true_poses = asked.true_poses
    record.plan, record.metrics, record.unmeasured = verdict.plan, verdict.metrics, verdict.unmeasured
    end(record, verdict.failure)
    return record


def keep(record: RunRecord, paths: RunPaths, which: str) -> None:
    """Bring the files of a run to disk, or remove a recording that is not kept.

    Args:
        record: names the files from now on.
        paths: of the run.
        which: `all`, `failed` or `none`.

    Raises:
        OSError: a file cannot be read or written.
    """
    wanted = which == "all" or (which == "failed" and record.status != RunStatus.SUCCEEDED)
    record.files = seal(paths, recording=wanted)
    if not wanted:
        paths.recording.unlink(missing_ok=True)


def end(record: RunRecord, failure: Failure | None) -> None:
    """Give a record the status and the reason of a failure; None: the run succeeded."""
    if failure is None:
        return
    record.status = failure.status
    record.error = RunError(stage=failure.stage, message=printable(failure.message))
