"""What travels to a worker and back: plain data, so that it may cross machines."""

from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.model.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths


@attrs.frozen(kw_only=True)
class Job:
    """One run to execute."""

    run_id: str
    parcel: dict[str, Any]
    """The configuration; see `mrpbench_core.config.study.unpack`."""
    paths: RunPaths
    log: Path
    """Receives what plugins print."""
    wall_s: float
    memory_bytes: int

    def message(self) -> dict[str, Any]:
        """What the child needs to know, as JSON."""
        return {
            "run_id": self.run_id,
            "parcel": self.parcel,
            "recording": str(self.paths.recording),
            "exports": str(self.paths.exports),
            "picture": None if self.paths.picture is None else str(self.paths.picture),
            "log": str(self.log),
            "memory_bytes": self.memory_bytes,
        }


@attrs.frozen(kw_only=True)
class Failure:
    """A run that has no record of its own: it was killed, died, or a plugin raised an exception."""

    status: RunStatus
    stage: Stage
    message: str
    seconds: float
    """Wall time in that stage."""
    scenario_id: str | None = None


@attrs.frozen(kw_only=True)
class JobOutcome:
    """How a job ended: with a record, a failure, or a mistake."""

    run_id: str
    record: dict[str, Any] | None = None
    failure: Failure | None = None
    lost: bool = False
    """The failure is that something outside ended the worker, which says nothing about the run."""
    mistake: str | None = None
    """The user's, or a full disk, in one line: the run is not recorded."""
    machine: dict[str, Any] | None = None
    """Where it was executed."""
