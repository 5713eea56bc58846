"""Print the progress of a study: one line that is updated on a terminal, one line per finished run elsewhere."""

import shutil
import sys
import time
from collections import Counter
from typing import Any

from mrpbench_core.cli.output.terminal import ERASE_LINE, unescaped
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.selection import Selection
from mrpbench_core.files.printing import printable
from mrpbench_core.files.text import counted
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.report.reading.axes import word
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results

SHORT = 12
"""Printed characters of a run id; commands accept any unique prefix."""
REFRESH_S = 0.1
PRINTED_S = 60.0
"""Seconds between two lines on how long a study has taken, where there is no live line."""
GOING_S = 0.5
"""Seconds between two looks at how far a run is."""


class Printed(StudyProgress):
    """Prints to standard output."""

    def __init__(self, live: bool | None = None) -> None:
        """With `live` (default: on a terminal), successful runs are only counted."""
        self._live = sys.stdout.isatty() if live is None else live
        self.interval_s = GOING_S if self._live else None
        self._progress: dict[str, dict[str, Any]] = {}
        self._total = 0
        self._going: dict[str, StudyRun] = {}
        self._counts: Counter[str] = Counter()
        self._began = self._drawn = self._printed = time.monotonic()
        self._folder: ResultsFolder | None = None
        self._warned = False

    def selected(self, selection: Selection, results: Results) -> None:
        """Print the number of runs to execute."""
        for error in results.damaged:
            sys.stderr.write(f"{error}\n")
        self._total, self._counts, self._folder = len(selection.todo), Counter(), results.folder
        self._began = self._printed = time.monotonic()
        self._warned = False
        recorded = sum(run_id in results for run_id in selection.chosen)
        chosen = counted(len(selection.chosen), "run")
        print(f"{results.folder.path}: {self._total} of {chosen} to do, {recorded} recorded")
        if selection.changed:
            print(
                f"{len(selection.changed)} recorded runs were made with other versions or sources of plugins"
                " (`--rerun changed` does them again)"
            )
        sys.stdout.flush()

    def started(self, point: StudyRun) -> None:
        """Show the run in the live line."""
        self._going[point.run_id] = point
        self._draw()

    def going(self, progress: list[dict[str, Any]]) -> None:
        """Show simulated time and arrived robots of the runs in the live line."""
        self._progress = {facts["run_id"]: facts for facts in progress}
        self._draw()

    def finished(self, point: StudyRun, record: dict[str, Any]) -> None:
        """Count the run; on a terminal only a failure gets a line of its own."""
        said = [(record.get("error") or {}).get("message", "")]
        said += [f"no export {name}: {reason}" for name, reason in record.get("unexported", {}).items()]
        if record["status"] == RunStatus.CRASHED and self._folder is not None:
            said.append(f"see {self._folder.log(point.run_id)}")
        self._end(point, record["status"], "; ".join(filter(None, said)))
        if record["status"] == RunStatus.GOALS_MISSED and not self._warned and (note := _too_short(record)):
            self._warned = True
            self._say(note)

    def lost(self, point: StudyRun, reason: str) -> None:
        """Print that the run is repeated."""
        self._going.pop(point.run_id)
        self._say(f"{point.run_id[:SHORT]} is repeated: {reason}")

    def refused(self, point: StudyRun, mistake: str) -> None:  # noqa: ARG002
        """Count the run; the error is printed at the end, once for all runs that it affects."""
        self._going.pop(point.run_id)
        self._counts["not run"] += 1
        self._draw()

    def close(self) -> None:
        """Remove the live line."""
        if self._live:
            self._erase()
            sys.stdout.flush()

    def _end(self, point: StudyRun, status: str, message: str) -> None:
        self._going.pop(point.run_id)
        self._counts[status] += 1
        if not self._live or status in (RunStatus.CRASHED, RunStatus.OUT_OF_MEMORY, RunStatus.WALL_TIMEOUT):
            done = f"[{self._counts.total()}/{self._total}]"
            axes = " ".join(f"{key}={word(value)}" for key, value in point.axes.items())
            line = " ".join(filter(None, (done, point.run_id[:SHORT], status, axes)))
            self._say(f"{line}: {message}" if message else line)
        if not self._live and (now := time.monotonic()) - self._printed >= PRINTED_S:
            self._printed = now
            self._say(f"{self._counts.total()} of {self._total} runs after {self._clocks(now)}")
        self._draw()

    def _far(self, run_id: str) -> str:
        """The run, and how far it is in its execution."""
        name, facts = run_id[:SHORT], self._progress.get(run_id)
        if facts is None:
            return name
        simulated, limit = f"{facts['simulated_s']:.0f}", f"{facts['limit_s']:g} s"
        arrived, robots = facts["arrived"], counted(facts["robots"], "robot")
        if len(self._going) > 1:
            return f"{name} ({simulated}/{limit}, {arrived}/{facts['robots']})"
        return f"{name}: {simulated} of {limit} simulated, {arrived} of {robots} arrived"

    def _say(self, line: str) -> None:
        self._erase()
        print(printable(line), flush=True)

    def _erase(self) -> None:
        if self._live:
            unescaped().write(ERASE_LINE)

    def _draw(self) -> None:
        now = time.monotonic()
        if not self._live or now - self._drawn < REFRESH_S:
            return
        self._drawn = now
        done = self._counts.total()
        counts = ", ".join(f"{count} {status}" for status, count in self._counts.most_common())
        going = " ".join(self._far(run_id) for run_id in self._going)
        line = f"[{done}/{self._total}] {' · '.join(filter(None, (counts, self._clocks(now), going)))}"
        width = shutil.get_terminal_size().columns - 1  # a wrapped line cannot be erased
        self._erase()
        print(printable(line)[:width], end="", flush=True)

    def _clocks(self, now: float) -> str:
        """The time since the beginning and, after the first run, the time that is left."""
        passed, done = now - self._began, self._counts.total()
        left = f", about {_clock(passed / done * (self._total - done))} left" if done else ""
        return _clock(passed) + left


def _too_short(record: dict[str, Any]) -> str | None:
    """Say that no execution within the limit could end a plan."""
    takes, limit = record["metrics"].get("planning.makespan"), record["config"]["limits"]["execution"]
    if takes is None or takes <= limit:
        return None
    return (
        f"note: the plan of {record['run_id'][:SHORT]} takes {takes:.0f} s, and limits.execution is {limit:g} s, so its"
        " robots cannot arrive: raise limits.execution"
    )


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
