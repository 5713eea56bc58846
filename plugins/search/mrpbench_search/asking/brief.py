"""Configurations as users write them: without the options that have their defaults."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.config.identity import choices
from mrpbench_core.config.shared import Shared
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.config.validation import default_of
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.call import in_worker


def brief_config(point: StudyRun, folder: Path) -> dict[str, Any]:
    """Return the configuration of a run as plain data that a study in another folder may have.

    Args:
        point: the run.
        folder: to which the files in the result are relative.

    Raises:
        InputErrors: a file has changed, or a plugin is missing.
    """
    brief: dict[str, Any] = in_worker("the configuration cannot be written", write_brief, point.parcel)
    moved: dict[str, Any] = _moved(brief, point.folder, folder.absolute())
    return moved


def write_brief(parcel: Mapping[str, Any]) -> dict[str, Any]:
    """In a worker process: return what differs from the defaults in a configuration."""
    config = unpack(parcel)
    chosen = choices(config, Path(parcel["folder"]), Shared())
    brief: dict[str, Any] = _pruned(parcel["config"], chosen)
    metrics = parcel["config"]["metrics"]
    brief["metrics"] = [_named(block, metric) for block, metric in zip(metrics, config.metrics.values(), strict=False)]
    return brief


def _named(block: dict[str, Any], component: Any) -> Any:
    """The name of a component, or a block of the options that differ from their defaults."""
    own = {
        str(field.alias): block[str(field.alias)]
        for field in attrs.fields(type(component))
        if getattr(component, field.name) != default_of(field, component)
    }
    return {"plugin": block["plugin"], **own} if own else block["plugin"]


def _pruned(plain: Any, chosen: Any) -> Any:
    """The part of plain data that was chosen; names of files in place of their hashes."""
    if isinstance(plain, dict) and isinstance(chosen, dict):
        found = {key: _pruned(plain[key], value) for key, value in chosen.items() if key in plain}
        return found["plugin"] if found.keys() == {"plugin"} else found
    if isinstance(plain, list) and isinstance(chosen, list) and len(plain) == len(chosen):
        return [_pruned(one, other) for one, other in zip(plain, chosen, strict=True)]
    return plain


def _moved(value: Any, origin: Path, folder: Path) -> Any:
    """Plain data with the names of files and of local plugins relative to another folder."""
    if isinstance(value, dict):
        if value.keys() == {"path", "sha256"}:
            return _relative(value["path"], origin, folder)
        return {key: _moved(inner, origin, folder) for key, inner in value.items()}
    if isinstance(value, list):
        return [_moved(inner, origin, folder) for inner in value]
    file, colon, cls = value.rpartition(":") if isinstance(value, str) else ("", "", "")
    if not colon or not file.endswith(".py"):
        return value
    moved = _relative(file, origin, folder)
    return f"{moved if moved.startswith('.') else f'./{moved}'}:{cls}"


def _relative(name: str, origin: Path, folder: Path) -> str:
    return Path(os.path.relpath(origin / name, folder)).as_posix()
