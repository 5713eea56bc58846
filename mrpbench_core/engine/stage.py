"""The interface of the stages: inputs, announcements, and the exception that ends a run."""

from collections.abc import Callable
from typing import Any

import attrs

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.observers import Observers
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.store.paths import RunPaths

Announce = Callable[[Stage, dict[str, Any]], None]
"""Called with each stage before it begins, and with facts about the run so far."""


@attrs.frozen(kw_only=True)
class RunInputs:
    """The inputs that the stages of one run share."""

    config: RunConfig
    paths: RunPaths
    announce: Announce
    observers: Observers
    timing: dict[str, Any]
    """Receives wall and CPU times; part of the record."""


class RunEnded(Exception):  # noqa: N818 - not an error
    """The run ended without success, with a definite status."""

    def __init__(self, status: RunStatus, stage: Stage, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.stage = stage
