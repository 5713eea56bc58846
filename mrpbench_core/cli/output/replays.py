"""Replays for the links of reports and sites, written by the distribution that has the command `view`."""

import logging
import os
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any, Protocol, cast
from urllib.parse import quote

from mrpbench_core.cli.command import find
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.links import followed
from mrpbench_core.report.report import Report
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

_LOG = logging.getLogger(__name__)


class ReplayWriter(Protocol):
    """What the module of the command `view` has besides the command."""

    def write_replay(self, recording: Recording, results: Results, record: dict[str, Any], page: Path) -> None:
        """Write the page of a recorded run."""

    def write_replays(self, runs: Sequence[tuple[Results, dict[str, Any]]], names: Sequence[str], page: Path) -> None:
        """Write the page of two recorded runs side by side."""

    def wrote(self, page: Path) -> bool:
        """Tell whether this version wrote the page of a run."""

    def wrote_pair(self, page: Path) -> bool:
        """Tell whether this version wrote the page of two runs."""


@cache
def replay_writer() -> ReplayWriter | None:
    """Return what writes replays; None, with one warning, if no installed distribution does."""
    try:
        return cast(ReplayWriter, find("view", ())[1])
    except InputError as error:
        _LOG.warning("no replays: %s", error)
        return None


def make_replays(report: Report, page: Path, most: int, first: Sequence[int] = ()) -> dict[str, str]:
    """Write replays of up to `most` runs without one; return the addresses of all replays, relative to `page`.

    The runs `first` come first, then failed ones, and every configuration gets one before another gets a second one. A
    page that may run other scripts than those of this version counts as none.
    """
    writer = replay_writer()
    if writer is None:
        return {}
    addresses: dict[str, str] = {}
    lacking: list[tuple[Results, str, Path]] = []
    there = [{file.name for file in results.folder.path.glob("replay-*.html")} for results in report.folders]
    recorded = [any((results.folder.path / "recordings").glob("*.zip")) for results in report.folders]
    order = dict.fromkeys([*first, *report.failures_first().tolist()]) if any(there) or any(recorded) else ()
    for index in order:
        run_id, folder = report.runs.run_id[index], int(report.runs.folder[index])
        results = report.folders[folder]
        file = results.folder.replay(run_id)
        if file.name in there[folder] and writer.wrote(file):
            addresses[run_id] = _address(file, page)
        elif recorded[folder] and len(lacking) < most and results.paths(run_id).recording.is_file():
            lacking.append((results, run_id, file))
    with slots_of_this_process():  # one worker for all replays
        for results, run_id, file in lacking:
            if try_write_replay(results, run_id, file):
                addresses[run_id] = _address(file, page)
    return addresses


def try_write_replay(results: Results, run_id: str, page: Path) -> bool:
    """Write the replay of a recorded run; False if nothing moves, and, with a warning, if it is damaged."""
    writer = replay_writer()
    if writer is None:
        return False
    try:
        recording = results.recording(run_id)
        try:
            if recording.pose_channel is None:
                return False
            writer.write_replay(recording, results, results[run_id], page)
        finally:
            recording.close()
    except InputError as error:
        _LOG.warning("%s", error)
        return False
    return True


def make_pair(report: Report, page: Path, first: int, second: int) -> str | None:
    """Write two runs side by side unless the page is there, and return its address; None if it cannot be written."""
    writer = replay_writer()
    if writer is None:
        return None
    ids = [report.runs.run_id[index] for index in (first, second)]
    folders = [report.folders[int(report.runs.folder[index])] for index in (first, second)]
    file = folders[0].folder.replay(*ids)
    if not writer.wrote_pair(file):
        try:
            runs = [(results, results[run_id]) for results, run_id in zip(folders, ids, strict=True)]
            writer.write_replays(runs, [run_id[:12] for run_id in ids], file)
        except InputError as error:
            _LOG.warning("%s", error)
            return None
    return _address(file, page)


def _address(file: Path, page: Path) -> str:
    return quote(Path(os.path.relpath(file, followed(page).parent)).as_posix())  # also a colon, else of a scheme
