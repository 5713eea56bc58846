"""Replays that a report links to."""

import os
from collections.abc import Sequence
from pathlib import Path

from mrpbench_core.cli.view import replay_file, write_replay
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.status import RunStatus
from mrpbench_core.report.analysis import Analysis
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results


def make_replays(analysis: Analysis, page: Path, most: int) -> dict[str, str]:
    """Write replays of up to `most` runs that have none; returns the addresses of all, relative to `page`.

    Failed runs come first, and every configuration gets its turn before another gets a second one.
    """
    found: dict[str, str] = {}
    lacking: list[tuple[Results, str, Path]] = []
    for index in _order(analysis):
        run_id = analysis.runs.run_id[index]
        results = analysis.folders[analysis.runs.folder[index]]
        file = replay_file(results, run_id)
        if file.is_file():
            found[run_id] = _address(file, page)
        elif len(lacking) < most and results.folder.run(run_id).recording.is_file():
            lacking.append((results, run_id, file))
    for results, run_id, file in lacking:
        try:
            recording = Recording(results.folder.run(run_id).recording)
            try:
                write_replay(recording, results, results[run_id], file)
            finally:
                recording.close()
        except InputError:  # a damaged recording costs its replay, not the report
            continue
        found[run_id] = _address(file, page)
    return found


def _order(analysis: Analysis) -> Sequence[int]:
    runs = analysis.runs
    groups = [group for setting in analysis.settings for group in setting.groups]
    turns = [
        (succeeded, turn, number, index)
        for number, group in enumerate(groups)
        for succeeded in (False, True)
        for turn, index in enumerate(
            i for i in group.members.tolist() if (runs.status[i] == RunStatus.SUCCEEDED) == succeeded
        )
    ]
    return [index for *_, index in sorted(turns)]


def _address(file: Path, page: Path) -> str:
    return Path(os.path.relpath(file, page.resolve().parent)).as_posix()
