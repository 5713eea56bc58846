"""The interface of the stages: inputs, announcements, and the exception that ends a run."""

from collections.abc import Callable
from typing import Any

import attrs

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.referee.verdict import Failure
from mrpbench_core.store.paths import RunPaths

Announce = Callable[[Stage, dict[str, Any]], None]
"""Called with each stage before it begins, and with facts about the run so far."""


def ignore(*_: Any, **__: Any) -> None:
    """Take announcements and progress where no process waits for them."""


@attrs.frozen(kw_only=True)
class RunInputs:
    """The inputs that the stages of one run share."""

    config: RunConfig
    run_id: str
    paths: RunPaths
    instance: str | None
    """Name of the instance, for the recording; None: the recording holds it."""
    announce: Announce = ignore
    hooks: Hooks = attrs.field(factory=Hooks)
    progress: Callable[..., None] = ignore
    """Called with `simulated_s`, `limit_s`, `arrived` and `robots`, at most twice a second of wall time."""
    timing: dict[str, Any] = attrs.field(factory=dict)
    """Receives wall and CPU times; part of the record."""


class RunEnded(Exception):  # noqa: N818 - not an error
    """The run ended without success, with a definite status."""

    def __init__(self, status: RunStatus, stage: Stage, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.stage = stage
        self.scenario_id: str | None = None
        """The scenario, where the run ended before there was an instance."""

    @property
    def failure(self) -> Failure:
        """The same as plain data."""
        return Failure(status=self.status, stage=self.stage, message=str(self))
