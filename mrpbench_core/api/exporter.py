"""Contract of the kind *exporter* (provisional)."""

from abc import ABC, abstractmethod
from pathlib import Path
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext


class ExporterSession(ABC):
    """Writes one run."""

    @abstractmethod
    def write(self, chunk: Chunk) -> None:
        """Append the samples since the last chunk."""

    @abstractmethod
    def close(self) -> None:
        """Finish the file; until then it has a temporary name or is readable at any time."""

    def abandon(self) -> None:  # noqa: B027 - optional: there may be nothing to remove
        """Remove the unfinished file, because the run failed."""


class Exporter(Component):
    """Writes runs in the format of another program, during the run or from a stored recording."""

    group: ClassVar[str] = "mrpbench.exporters"

    @abstractmethod
    def open(self, context: RunContext, destination: Path) -> ExporterSession:
        """Begin to write to `destination`, a path without suffix in an existing folder; replace an existing file."""
