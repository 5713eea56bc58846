"""The Python API `run`, and what it shares with the command line."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.engine.study.selection import Rerun, read_shard_option
from mrpbench_core.engine.study.study import Request, run_study
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.store.results import Results


def run(
    config: Path | str | Mapping[str, Any],
    *overrides: str,
    out: Path | str | None = None,
    workers: int = 1,
    executor: str = "processes",
    executor_options: Mapping[str, Any] | None = None,
    shard: str | None = None,
    rerun: Rerun | None = None,
    progress: StudyProgress | None = None,
) -> Results:
    """Do the runs of a study that have no record yet, and return the records of all its runs.

    Args:
        config: a configuration file, or what one would say, as a dict.
        overrides: as on the command line, e.g. `"planner.w=1.5"`, `"seed=0..9"`.
        out: results folder; by default `results/<name>` in the working directory.
        workers: runs at once.
        executor: where runs execute, by name.
        executor_options: options of that executor.
        shard: `"i/n"`, only part i (from 0) of n.
        rerun: also do again what `failed`, `changed`, or `all`.
        progress: receives the progress of the study.

    Raises:
        InputErrors, InputError: the configuration is wrong, or some runs cannot be made of it. Runs that could be made
            are recorded before.
    """
    with slots_of_this_process() as slots:
        study = read_study(slots, config, overrides)
        request = prepare(
            study.name,
            slots,
            overrides,
            out=out,
            workers=workers,
            executor=executor,
            executor_options=executor_options,
            shard=shard,
            rerun=rerun,
            progress=progress,
        )
        done = run_study(study, request)
    mistakes = [InputError(mistake) for mistake in dict.fromkeys(done.mistakes.values())]
    if study.errors or mistakes:
        raise InputErrors(*study.errors, *mistakes)
    return done.results


def prepare(
    name: str,
    slots: str,
    overrides: Sequence[str] = (),
    *,
    out: Path | str | None = None,
    workers: int = 1,
    executor: str = "processes",
    executor_options: Mapping[str, Any] | None = None,
    shard: str | None = None,
    rerun: Rerun | None = None,
    progress: StudyProgress | None = None,
) -> Request:
    """The options of the study `name`, with a key of `slots_of_this_process`; see `run`.

    Raises:
        InputErrors, InputError: what is wrong with that.
    """
    if workers < 1:
        raise InputError(f"workers: at least 1, got {workers}")
    block = from_data({"plugin": executor, **(executor_options or {})}, Location())
    return Request(
        out=Path("results") / name if out is None else Path(out),
        slots=slots,
        executor=structure_component(ExecutorSource, block, "executor", Path.cwd()),  # type: ignore[type-abstract]
        workers=workers,
        shard=None if shard is None else read_shard_option(shard),
        rerun=rerun,
        overrides=tuple(overrides),
        progress=progress or StudyProgress(),
    )
