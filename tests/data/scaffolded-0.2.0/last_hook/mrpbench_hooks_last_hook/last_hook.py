"""LastHook: a summary when a study ends."""

import sys
from collections import Counter
from collections.abc import Mapping
from typing import Any

from mrpbench_core.api import hookimpl


class LastHook:
    """Counts the statuses of the runs of a study, and names the run that took longest to plan."""

    def __init__(self) -> None:
        self.statuses: Counter[str] = Counter()
        self.slowest = (0.0, "")

    @hookimpl
    def mrpbench_study_started(self) -> None:
        """Forget the study before."""
        self.__init__()  # type: ignore[misc]

    @hookimpl
    def mrpbench_run_finished(self, record: Mapping[str, Any]) -> None:
        """Note the status and the planning time of a run."""
        self.statuses[record["status"]] += 1
        seconds = record.get("timing", {}).get("planning_s") or 0.0
        self.slowest = max(self.slowest, (float(seconds), str(record["run_id"])))

    @hookimpl
    def mrpbench_study_finished(self) -> None:
        """Write one line to standard error."""
        counts = ", ".join(f"{number} {status}" for status, number in sorted(self.statuses.items()))
        seconds, run = self.slowest
        longest = f"; longest planning {seconds:.2f} s (run {run[:8]})" if run else ""
        sys.stderr.write(f"last_hook: {counts or 'no new runs'}{longest}\n")


hooks = LastHook()
"""The entry point names this object, because hooks are its methods."""
