"""Executes the runs of a study that have no record yet."""

import os
from collections import deque
from contextlib import closing
from datetime import UTC, datetime
from typing import Any

import attrs

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.study.calls import opened
from mrpbench_core.engine.study.commits import Commits
from mrpbench_core.engine.study.hooks import StudyHooks
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.run_queue import RunQueue
from mrpbench_core.engine.study.selection import Selection, select
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.files.output import sync_folder
from mrpbench_core.store.folder import ResultsFolder, new_invocation
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.lock import locked
from mrpbench_core.store.results import Results, origin


@attrs.frozen(kw_only=True)
class StudyOutcome:
    """The result of an invocation."""

    results: Results
    """Every record of the chosen runs, new and old."""
    mistakes: dict[str, str]
    """The error of each refused run, by run id."""


def choose(study: StudyRuns, options: StudyOptions) -> tuple[Selection, Results]:
    """Select the runs that would be executed now, and read the records of the study's runs; nothing on disk changes."""
    results = Results(ResultsFolder(options.folder_of(study.name)), only=(point.run_id for point in study.runs))
    origins: dict[int, str] = {}

    def origin_now(point: StudyRun) -> str:
        if id(point.code) not in origins:
            origins[id(point.code)] = origin(point.code)
        return origins[id(point.code)]

    return select(study.runs, results, options.rerun, options.shard, origin_now), results


def run_study(study: StudyRuns, options: StudyOptions, slots: str) -> StudyOutcome:
    """Execute the runs that `choose` selects, with a key of `slots_of_this_process`.

    Raises:
        InputError: the results folder cannot be used.
        KeyboardInterrupt: after the runs in flight were ended; everything finished is kept.
    """
    folder = ResultsFolder(options.folder_of(study.name))
    folder.create()
    with locked(folder.path), closing(options.progress):
        selection, results = choose(study, options)
        try:
            folder.sweep()
            results.remove_superseded()
        except OSError as error:
            raise InputError(f"cannot be removed: {error.strerror}", file=error.filename or folder.path) from error
        options.progress.selected(selection, results)
        mistakes = _do(study, options, slots, folder, selection) if selection.todo else {}
        return StudyOutcome(results=Results(folder, only=selection.chosen), mistakes=mistakes)


def _do(
    study: StudyRuns, options: StudyOptions, slots: str, folder: ResultsFolder, selection: Selection
) -> dict[str, str]:
    """Execute the selected runs; returns the mistakes in those that were refused."""
    invocation = new_invocation()
    try:
        digest = write_document(folder.invocation(invocation), _facts(study, options, invocation))
        write_document(folder.study, study.document)
        shard = Writer(folder.shard(invocation), exclusive=True)
        sync_folder(shard.path.parent)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=error.filename or folder.path) from error
    with closing(shard), StudyHooks() as hooks, opened(options.executor, options.workers, slots) as calls:
        schedule = RunQueue(
            calls=calls,
            waiting=deque(selection.todo),
            workers=options.workers,
            folder=folder,
            commits=Commits(
                folder=folder,
                shard=shard,
                invocation=f"{digest}  invocations/{invocation}.yaml",
                workers=options.workers,
            ),
            hooks=hooks,
            progress=options.progress,
        )
        hooks.call("mrpbench_study_started", study=study.document, runs=len(selection.todo))
        schedule.run_all()
        hooks.call("mrpbench_study_finished", records=len(selection.todo) - len(schedule.mistakes))
    return schedule.mistakes


def _facts(study: StudyRuns, options: StudyOptions, invocation: str) -> dict[str, Any]:
    """The facts that are needed to repeat the invocation and to read its records."""
    codes = {id(point.code): point.code for point in study.runs}.values()
    return {
        "invocation": invocation,
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        "process": os.getpid(),
        "machine": machine(),
        "versions": {name: version for code in codes for name, version in code["versions"].items()},
        "columns": study.columns,
        "overrides": list(options.overrides),
        "study": study.document,
    }
