"""The Python API `run`."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.results import Results


def run(config: Path | str | Mapping[str, Any], *overrides: str, **options: Any) -> Results:
    """Do the runs of a study that have no record yet, and return the records of all its runs.

    Args:
        config: a configuration file, or what one would say, as a dict.
        overrides: as on the command line, e.g. `"planner.w=1.5"`, `"seed=0..9"`.
        options: fields of `StudyOptions`: `out`, `workers`, `executor`, `shard`, `rerun`, `progress`.

    Raises:
        InputErrors, InputError: the configuration is wrong, or some runs cannot be made of it. Runs that could be made
            are recorded before.
    """
    chosen = StudyOptions(overrides=overrides, **options)
    with slots_of_this_process() as slots:
        study = read_study(config, chosen.overrides)
        done = run_study(study, chosen, slots)
    mistakes = [InputError(mistake) for mistake in dict.fromkeys(done.mistakes.values())]
    if study.errors or mistakes:
        raise InputErrors(*study.errors, *mistakes)
    return done.results
