"""The input and the output of a worker slot: plain data, which may cross machines."""

from pathlib import Path
from typing import Any, Self

import attrs

from mrpbench_core.engine.record import RunRecord
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths


@attrs.frozen(kw_only=True)
class Job:
    """One run to execute."""

    run_id: str
    parcel: dict[str, Any]
    """The configuration; see `mrpbench_core.config.unpacking`."""
    keep: str
    """Of which runs the recording is kept: `all`, `failed` or `none`."""
    facts: dict[str, Any]
    """See `mrpbench_core.engine.asking.facts_of_run`."""
    paths: RunPaths
    log: Path
    """Receives the output of plugins."""
    wall_s: float
    memory_bytes: int

    def message(self) -> dict[str, Any]:
        """The job as JSON, for the supervisor and the worker."""
        return {
            "run_id": self.run_id,
            "parcel": self.parcel,
            "facts": self.facts,
            "keep": self.keep,
            "recording": str(self.paths.recording),
            "exports": str(self.paths.exports),
            "picture": None if self.paths.picture is None else str(self.paths.picture),
            "log": str(self.log),
            "wall_s": self.wall_s,
            "memory_bytes": self.memory_bytes,
        }


@attrs.frozen(kw_only=True)
class Failure:
    """A run without a record of its own: it was ended, its process died, or a plugin raised an exception."""

    status: RunStatus
    stage: Stage
    message: str
    seconds: float
    """Wall time in that stage."""
    scenario_id: str | None = None
    lost: bool = False
    """Something outside ended the process, which says nothing about the run."""

    @classmethod
    def of_message(cls, message: dict[str, Any]) -> Self:
        """The failure that a supervisor sent."""
        return cls(**{**message, "status": RunStatus(message["status"]), "stage": Stage(message["stage"])})


@attrs.frozen(kw_only=True)
class JobOutcome:
    """The result of a job: a record, a failure, or a user's mistake."""

    run_id: str
    record: RunRecord | None = None
    failure: Failure | None = None
    mistake: str | None = None
    """A mistake of the user or a full disk, in one line: the run is not recorded."""
    machine: dict[str, Any] | None = None
    """The machine that executed the run."""
