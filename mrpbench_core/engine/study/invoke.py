"""`run`, the Python function that does the runs of a study."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.selection import Rerun
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.results import Results


def run(
    config: Path | str | Mapping[str, Any],
    *overrides: str,
    out: Path | str | None = None,
    workers: int = 1,
    executor: str | Mapping[str, Any] = "processes",
    shard: str | None = None,
    rerun: Rerun | None = None,
    progress: StudyProgress | None = None,
) -> Results:
    """Do the runs of a study that have no record yet, and return the records of all its runs.

    Args:
        config: a configuration file, or what one would say, as a dict.
        overrides: as on the command line, e.g. `"planner.w=1.5"`, `"seed=0..9"`.
        out: results folder; None = `results/<name>` in the working directory.
        workers: largest number of runs at a time.
        executor: where runs execute: a name, or a block with `plugin` and options.
        shard: `"i/n"`: only part i (from 0) of n.
        rerun: also repeat runs that failed, whose versions or sources changed, or all.
        progress: receives the progress of the study.

    Raises:
        InputErrors, InputError: the configuration is wrong, or some runs cannot be made of it. Runs that could be made
            are recorded before.
    """
    chosen = StudyOptions(
        overrides=overrides,
        out=out,
        workers=workers,
        executor=executor,
        shard=shard,
        rerun=rerun,
        progress=progress or StudyProgress(),
    )
    with slots_of_this_process() as slots:
        study = read_study(config, chosen.overrides)
        done = run_study(study, chosen, slots)
    mistakes = [InputError(mistake) for mistake in dict.fromkeys(done.mistakes.values())]
    if study.errors or mistakes:
        raise InputErrors(*study.errors, *mistakes)
    return done.results
