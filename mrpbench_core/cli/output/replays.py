"""Writes replays, for `mrpbench view` and for the links of a report."""

import logging
import os
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.parse import quote

import attrs

from mrpbench_core.api.planner import Planner
from mrpbench_core.config.canonical import json_scalar
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.links import followed
from mrpbench_core.files.yaml import load as load_yaml
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.local import is_local
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.report.reading.columns import Columns, describe_columns
from mrpbench_core.report.replay.facts import numbers_of
from mrpbench_core.report.replay.motion import has_poses
from mrpbench_core.report.replay.page import template, write_page
from mrpbench_core.report.replay.pair import pair_template, write_pair
from mrpbench_core.report.report import Report
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results

_LOG = logging.getLogger(__name__)


def write_replay(recording: Recording, results: Results, record: dict[str, Any], page: Path) -> None:
    """Write the page of a recorded run, with the units of its metrics and the options of its planner."""
    planner = _planner(record["config"].get("planner", "none"))
    write_page(recording, record, page, columns=_columns(results, record), planner=planner)


def write_replays(runs: Sequence[tuple[Results, dict[str, Any]]], names: Sequence[str], page: Path) -> None:
    """Write the page of two recorded runs side by side."""
    with TemporaryDirectory() as folder:
        pages = [Path(folder) / f"{number}.html" for number in range(len(runs))]
        for (results, record), part in zip(runs, pages, strict=True):
            recording = results.recording(record["run_id"])
            try:
                write_replay(recording, results, record, part)
            finally:
                recording.close()
        write_pair(pages, names, page)


def _columns(results: Results, record: dict[str, Any]) -> Columns:
    """Return the columns of a run's metrics and timing, as declared by the invocation of the run."""
    entry = results.entry(record["run_id"])
    assert entry is not None
    try:
        declared = load_yaml(results.folder.invocation(entry.shard.stem)).data.get("columns")
    except (InputError, AttributeError):  # merged folders may lack it
        declared = None
    names = [name for name, _ in numbers_of(record)]
    return describe_columns(declared if isinstance(declared, dict) else {}, names)


def _planner(block: Any) -> str:
    """Return the planner's name, and the plain options that differ from their defaults if it is installed."""
    if not isinstance(block, dict):
        return str(block)
    name = str(block["plugin"])
    plain = {key: value for key, value in block.items() if key != "plugin" and isinstance(value, str | int | float)}
    installed = {provider.name for provider in providers(Planner.group)}
    if not plain or is_local(name) or name.partition("@")[0] not in installed:
        return name
    try:
        defaults = in_worker(f"the replay shows no options of {name}", defaults_of, name)
    except InputError as error:
        _LOG.warning("%s", error)
        return name
    chosen = [f"{key}={value}" for key, value in plain.items() if key in defaults and value != defaults[key]]
    return " ".join([name, *chosen])


def defaults_of(planner: str) -> dict[str, Any]:
    """In a worker process: the default of each option of an installed planner."""
    cls: Any = Registry(Planner).get(planner)  # type: ignore[type-abstract]
    found = {field.alias: json_scalar(field.default) for field in attrs.fields(cls)}
    return {key: value for key, value in found.items() if isinstance(value, str | int | float)}


def make_replays(report: Report, page: Path, most: int, first: Sequence[int] = ()) -> dict[str, str]:
    """Write replays of up to `most` runs without one; return the addresses of all replays, relative to `page`.

    The runs `first` come first, then failed ones, and every configuration gets one before another gets a second one. A
    page that may run other scripts than those of this version counts as none.
    """
    found: dict[str, str] = {}
    lacking: list[tuple[Results, str, Path]] = []
    there = [{file.name for file in results.folder.path.glob("replay-*.html")} for results in report.folders]
    recorded = [any((results.folder.path / "recordings").glob("*.zip")) for results in report.folders]
    order = dict.fromkeys([*first, *report.failures_first().tolist()]) if any(there) or any(recorded) else ()
    for index in order:
        run_id, folder = report.runs.run_id[index], int(report.runs.folder[index])
        results = report.folders[folder]
        file = results.folder.replay(run_id)
        if file.name in there[folder] and template().wrote(file):
            found[run_id] = _address(file, page)
        elif recorded[folder] and len(lacking) < most and results.paths(run_id).recording.is_file():
            lacking.append((results, run_id, file))
    with slots_of_this_process():  # one worker for all replays
        for results, run_id, file in lacking:
            if try_write_replay(results, run_id, file):
                found[run_id] = _address(file, page)
    return found


def try_write_replay(results: Results, run_id: str, page: Path) -> bool:
    """Write the replay of a recorded run; False if it ends before motion, or, with a warning, if it is damaged."""
    try:
        recording = results.recording(run_id)
        try:
            if not has_poses(recording):
                return False
            write_replay(recording, results, results[run_id], page)
        finally:
            recording.close()
    except InputError as error:
        _LOG.warning("%s", error)
        return False
    return True


def make_pair(report: Report, page: Path, first: int, second: int) -> str | None:
    """Write two runs side by side unless the page is there, and return its address; None if a recording is damaged."""
    ids = [report.runs.run_id[index] for index in (first, second)]
    folders = [report.folders[int(report.runs.folder[index])] for index in (first, second)]
    file = folders[0].folder.replay(*ids)
    if not pair_template().wrote(file):
        try:
            runs = [(results, results[run_id]) for results, run_id in zip(folders, ids, strict=True)]
            write_replays(runs, [run_id[:12] for run_id in ids], file)
        except InputError as error:
            _LOG.warning("%s", error)
            return None
    return _address(file, page)


def _address(file: Path, page: Path) -> str:
    return quote(Path(os.path.relpath(file, followed(page).parent)).as_posix())  # also a colon, else of a scheme
