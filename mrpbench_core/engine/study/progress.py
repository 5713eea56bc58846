"""Who is told in the invoking process how a study goes on."""

from typing import Any

from mrpbench_core.config.study import RunPoint
from mrpbench_core.engine.study.selection import Selection
from mrpbench_core.store.results import Results


class StudyProgress:
    """Does nothing; subclasses print or draw."""

    def selected(self, selection: Selection, results: Results) -> None:
        """The runs to do are known."""

    def started(self, point: RunPoint) -> None:
        """A run was handed to a worker."""

    def finished(self, point: RunPoint, record: dict[str, Any]) -> None:
        """A run's record was stored."""

    def lost(self, point: RunPoint, reason: str) -> None:
        """A run's worker was ended from outside; it will be done again."""

    def refused(self, point: RunPoint, mistake: str) -> None:
        """A run could not be made of what the user wrote; nothing was recorded."""
