"""The record of a run in types, until the invoking process writes it as one JSON object."""

from typing import Any, Self

import attrs

from mrpbench_core.model.runs.status import RunStatus, Stage


@attrs.frozen(kw_only=True)
class RunError:
    """The reason why a run did not succeed."""

    stage: Stage
    message: str
    """One line."""


@attrs.define(kw_only=True)
class RunRecord:
    """The part of a record that its process knows, filled stage by stage; see `docs/reference/results-folder.md`."""

    run_id: str
    scenario_id: str | None = None
    status: RunStatus = RunStatus.SUCCEEDED
    error: RunError | None = None
    executed: bool = False
    """The plan was executed to the end of the execution; a recording was written."""
    metrics: dict[str, Any] = attrs.field(factory=dict)
    """Values by `<metric>.<column>`, None = not measurable."""
    unmeasured: dict[str, str] = attrs.field(factory=dict)
    """The reason why a metric or `<metric>.<column>` cannot be measured, by name."""
    unexported: dict[str, str] = attrs.field(factory=dict)
    """The reason why an export failed, by the name of the format."""
    unarrived: dict[str, str] = attrs.field(factory=dict)
    """Why robots did not arrive, by their names; not with `tasks`."""
    reassigned: int = 0
    """The number of robots whose goal is not the one that the scenario gives them."""
    plan: dict[str, Any] = attrs.field(factory=dict)
    """Cost, bound and problem of the plan, for comparisons of runs; see `mrpbench_core.referee.plan_summary`."""
    true_poses: str | None = None
    """The localizer that `grant_truth` gave the true poses."""
    files: list[str] = attrs.field(factory=list)
    """SHA-256 and name of the recording and of each exported file; see `mrpbench_core.store.run_files.seal`."""
    timing: dict[str, Any] = attrs.field(factory=dict)
    """Wall and CPU seconds, bytes, and what depends on them."""

    def message(self) -> dict[str, Any]:
        """The record as plain data, for another process."""
        return {**attrs.asdict(self, recurse=False), "error": self.error and attrs.asdict(self.error)}

    @classmethod
    def of_message(cls, message: dict[str, Any]) -> Self:
        """The record that another process sent."""
        error = message["error"] and RunError(
            stage=Stage(message["error"]["stage"]), message=message["error"]["message"]
        )
        return cls(**{**message, "status": RunStatus(message["status"]), "error": error})


@attrs.define(kw_only=True)
class StoredRecord:
    """A run's record as results folders keep it."""

    run: RunRecord
    attempt: int
    config: dict[str, Any]
    """In canonical form."""
    seed: int
    repeat: int
    provenance: dict[str, Any]
    """Components, versions, machine, and whether something outside the process took part; `document` adds `files`."""
    analysis: dict[str, Any] | None = None
    """Of recordings that `mrpbench analyze` measured: sources and notes."""
    invocation: str = ""
    """SHA-256 and name of the document of the invocation, as in `RunRecord.files`."""

    def document(self) -> dict[str, Any]:
        """The record as one JSON object; empty parts are left out."""
        run = self.run
        document = {
            "run_id": run.run_id,
            "scenario_id": run.scenario_id,
            "attempt": self.attempt,
            "config": self.config,
            "seed": self.seed,
            "repeat": self.repeat,
            "status": run.status.value,
            "metrics": run.metrics,
            "timing": run.timing,
            "provenance": {**self.provenance, "files": [*run.files, *filter(None, [self.invocation])]},
        }
        error = run.error and {"stage": run.error.stage.value, "message": run.error.message}
        further = {
            "unmeasured": run.unmeasured,
            "unexported": run.unexported,
            "error": error,
            "unarrived": run.unarrived,
            "plan": run.plan,
            "reassigned": run.reassigned,
            "true_poses": run.true_poses,
            "analysis": self.analysis,
        }
        always = {"unmeasured"} if self.analysis else set()
        return document | {key: value for key, value in further.items() if value or key in always}
