"""Executes the runs of a study that have no record yet."""

import os
from collections import deque
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.study.commits import Commits
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.run_queue import RunQueue
from mrpbench_core.engine.study.selection import Rerun, Selection, select
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.files.output import sync_folder
from mrpbench_core.plugins.hooks import load_hooks
from mrpbench_core.store.folder import ResultsFolder, new_invocation
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.lock import locked
from mrpbench_core.store.results import Results, origin


@attrs.frozen(kw_only=True)
class Request:
    """The options of a study."""

    out: Path
    slots: str
    """Key of the worker slots."""
    executor: ExecutorSource
    workers: int = 1
    shard: tuple[int, int] | None = None
    """Part i of n."""
    rerun: Rerun | None = None
    overrides: tuple[str, ...] = ()
    """The part of the study that came from the command line."""
    progress: StudyProgress = attrs.field(factory=StudyProgress)


@attrs.frozen(kw_only=True)
class StudyOutcome:
    """The result of an invocation."""

    results: Results
    """Every record of the chosen runs, new and old."""
    mistakes: dict[str, str]
    """The error of each refused run, by run id."""


def choose(study: StudyRuns, request: Request) -> tuple[Selection, Results]:
    """Select the runs that would be executed now, and read the records of the study's runs; nothing on disk changes."""
    results = Results(ResultsFolder(request.out), only=(point.run_id for point in study.runs))
    origins: dict[int, str] = {}

    def origin_now(point: StudyRun) -> str:
        if id(point.code) not in origins:
            origins[id(point.code)] = origin(point.code)
        return origins[id(point.code)]

    return select(study.runs, results, request.rerun, request.shard, origin_now), results


def run_study(study: StudyRuns, request: Request) -> StudyOutcome:
    """Execute the runs that `choose` selects.

    Raises:
        InputError: the results folder cannot be used.
        KeyboardInterrupt: after the runs in flight were ended; everything finished is kept.
    """
    folder = ResultsFolder(request.out)
    folder.create()
    with locked(folder.path):
        selection, results = choose(study, request)
        try:
            folder.sweep()
            results.remove_superseded()
        except OSError as error:
            raise InputError(f"cannot be removed: {error.strerror}", file=error.filename or folder.path) from error
        request.progress.selected(selection, results)
        mistakes = _do(study, request, folder, selection) if selection.todo else {}
        return StudyOutcome(results=Results(folder, only=selection.chosen), mistakes=mistakes)


def _do(study: StudyRuns, request: Request, folder: ResultsFolder, selection: Selection) -> dict[str, str]:
    """Execute the selected runs; returns the mistakes in those that were refused."""
    invocation = new_invocation()
    hooks = load_hooks()
    hooks.check()
    try:
        digest = write_document(folder.invocation(invocation), _facts(study, request, invocation))
        write_document(folder.study, study.document)
        shard = Writer(folder.shard(invocation), exclusive=True)
        sync_folder(shard.path.parent)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=error.filename or folder.path) from error
    with closing(shard), request.executor.open(request.workers) as executor:
        schedule = RunQueue(
            slots=request.slots,
            waiting=deque(selection.todo),
            workers=request.workers,
            folder=folder,
            commits=Commits(
                folder=folder,
                shard=shard,
                invocation=f"{digest}  invocations/{invocation}.yaml",
                workers=request.workers,
            ),
            hooks=hooks,
            progress=request.progress,
        )
        hooks.call("mrpbench_study_started", study=study.document, runs=len(selection.todo))
        schedule.run_all(executor)
        hooks.call("mrpbench_study_finished", records=len(selection.todo) - len(schedule.mistakes))
    return schedule.mistakes


def _facts(study: StudyRuns, request: Request, invocation: str) -> dict[str, Any]:
    """The facts that are needed to repeat the invocation and to read its records."""
    codes = {id(point.code): point.code for point in study.runs}.values()
    return {
        "invocation": invocation,
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        "process": os.getpid(),
        "machine": machine(),
        "versions": {name: version for code in codes for name, version in code["versions"].items()},
        "columns": study.columns,
        "overrides": list(request.overrides),
        "study": study.document,
    }
