"""Does the runs that a search asks for in a results folder, and returns their records."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.text import counted
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results
from mrpbench_search.asking.budget import Budget


class SearchEnded(Exception):  # noqa: N818 - an answer is given from what is recorded
    """The next step is not done; the text says why."""


@attrs.define(kw_only=True)
class Requests:
    """The runs of one search.

    A search asks for runs step by step, and decides from their records alone what to ask for next. It is therefore
    repeated without any run being done twice, and each of its runs is one of `mrpbench run`.
    """

    options: StudyOptions
    slots: str
    """A key of `slots_of_this_process`."""
    budget: Budget = attrs.field(factory=Budget)
    asked: set[str] = attrs.field(factory=set, init=False)
    """Ids of all runs asked for."""
    _seconds: list[float] = attrs.field(factory=list, init=False)
    """Wall time of each run that was done or found."""

    def results(self, study: StudyRuns, points: Sequence[StudyRun]) -> Results:
        """Return the records of these runs, after those without a record were done.

        Raises:
            SearchEnded: the budget does not allow the step, or runs of other shards are missing.
            InputErrors: runs were refused because of a mistake of the user.
            KeyboardInterrupt: interrupted; finished runs are recorded.
        """
        wanted = {point.run_id for point in points}
        folder = ResultsFolder(self.options.folder_of(study.name))
        missing = len(wanted) - len(Results(folder, only=wanted))
        expected_s = missing * float(np.mean(self._seconds or [0.0])) / self.options.workers
        if not self.budget.allows(len(self.asked | wanted), expected_s):
            raise SearchEnded("the budget is spent")
        done = run_study(attrs.evolve(study, runs=tuple(points)), self.options, self.slots)
        if done.mistakes:
            raise InputErrors(*map(InputError, dict.fromkeys(done.mistakes.values())))
        self.asked |= wanted
        results = Results(folder, only=wanted)
        self._seconds += [seconds for seconds in map(_seconds, results) if seconds is not None]
        if elsewhere := len(wanted) - len(results):
            raise SearchEnded(
                f"{counted(elsewhere, 'run')} of other shards are not in {folder.path}: copy the results folders of all"
                " shards into each other and repeat the commands"
            )
        return results


def read_whole_study(source: str | Mapping[str, Any], overrides: Sequence[str] = ()) -> StudyRuns:
    """Read a study without errors, from a file or plain data.

    Raises:
        InputErrors: a run of it has one.
    """
    study = read_study(source, overrides)
    if study.errors:
        raise InputErrors(*study.errors)
    return study


def seeds_of(points: Iterable[StudyRun]) -> list[int]:
    """Return the seeds of runs in their order, each once."""
    return list(dict.fromkeys(point.canonical["seed"] for point in points))


def _seconds(record: dict[str, object]) -> float | None:
    timing = record.get("timing")
    value = timing.get("run_wall_s") if isinstance(timing, dict) else None
    return value if isinstance(value, float) else None
