"""Writes the page of a recorded run, or of two side by side, with the names and units that its record has."""

import logging
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs

from mrpbench_core.api.planner import Planner
from mrpbench_core.config.canonical import json_scalar
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load as load_yaml
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.local import is_local
from mrpbench_core.plugins.registry import Registry
from mrpbench_core.report.reading.columns import Columns, describe_columns
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results
from mrpbench_replay.facts import numbers_of
from mrpbench_replay.pair import write_pair
from mrpbench_replay.write_page import write_page

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
    defaults = {field.alias: json_scalar(field.default) for field in attrs.fields(cls)}
    return {key: value for key, value in defaults.items() if isinstance(value, str | int | float)}
