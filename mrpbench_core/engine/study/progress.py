"""Notifications about the progress of a study, in the invoking process."""

from typing import Any

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.study.selection import Selection
from mrpbench_core.store.results import Results


class StudyProgress:
    """Receives notifications and ignores them; subclasses print or draw."""

    interval_s: float | None = None
    """Wall seconds after which `going` is called while no run ends; None = never."""

    def selected(self, selection: Selection, results: Results) -> None:
        """The runs to execute are selected."""

    def started(self, point: StudyRun) -> None:
        """A run was handed to a worker."""

    def going(self, progress: list[dict[str, Any]]) -> None:
        """Runs are executed; `progress` says of each how far it is: run_id, simulated_s, limit_s, arrived, robots."""

    def finished(self, point: StudyRun, record: dict[str, Any]) -> None:
        """A run's record was stored."""

    def lost(self, point: StudyRun, reason: str) -> None:
        """A run's worker was ended from outside; the run will be repeated."""

    def refused(self, point: StudyRun, mistake: str) -> None:
        """A run could not be executed because of a mistake of the user; nothing was recorded."""

    def close(self) -> None:
        """The study has ended or was interrupted."""
