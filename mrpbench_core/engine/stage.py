"""What a stage tells the rest of the engine: that it begins, and that the run ends in it."""

from collections.abc import Callable
from typing import Any

from mrpbench_core.model.status import RunStatus, Stage

Announce = Callable[[Stage, dict[str, Any]], None]
"""Called with each stage before it begins, and with facts about the run so far."""


class RunEnded(Exception):  # noqa: N818 - it is no error
    """The run is over before its last stage, with a definite status."""

    def __init__(self, status: RunStatus, stage: Stage, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.stage = stage
