"""The identity of a run: a hash of its options, by which results are found and no run is done twice.

Only options that differ from their defaults count, so neither an explicit default nor an option that a later version of
a plugin adds changes the identity. Files count by content. The keys in `NOT_IDENTIFYING` do not count.
"""

import hashlib
import json
from collections.abc import Mapping, Set
from pathlib import Path
from typing import Any, cast

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.canonical import json_scalar, plugin_name
from mrpbench_core.config.content import content_hash
from mrpbench_core.config.settings import (
    EXECUTION,
    NOT_IDENTIFYING,
    ONLY_EXECUTION,
    FleetEntry,
    RunConfig,
    default_plugin,
)
from mrpbench_core.config.shared import Shared
from mrpbench_core.config.validation import default_of

LENGTH = 16
"""Hexadecimal digits of a run id."""


def run_id(config: RunConfig, folder: Path, shared: Shared | None = None) -> str:
    """Return the identity of a run, with files relative to `folder`."""
    chosen = choices(config, folder, shared or Shared())
    text = json.dumps(chosen, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:LENGTH]


def choices(config: RunConfig, folder: Path, shared: Shared) -> dict[str, Any]:
    """Return the options that identify a run, as plain data."""
    chosen, ignored = {}, _ignored(config)
    for field in attrs.fields(RunConfig):
        if field.name not in ignored and _differs(config, field):
            chosen[field.name] = shared(_chosen, getattr(config, field.name), folder, field.name, ignored)
    return {name: value for name, value in chosen.items() if value != {} and not _is_default_plugin(name, value)}


def options_text(component: Component) -> str:
    """Return the class of a component and its options that differ from their defaults, with files by content."""
    chosen = {
        field.alias: _chosen(getattr(component, field.name), Path(), "", frozenset())
        for field in attrs.fields(cast("Any", type(component)))
        if field.init and _differs(component, field)
    }
    return json.dumps({type(component).__qualname__: chosen}, sort_keys=True)


def _ignored(config: RunConfig) -> frozenset[str]:
    ignored = set(NOT_IDENTIFYING)
    if config.planner.assigns:
        ignored.add("assigner")  # the planner assigns the tasks itself
    if not config.executes:
        ignored |= {name for name in EXECUTION if getattr(config, name) is None} | set(ONLY_EXECUTION)
    return frozenset(ignored)


def _is_default_plugin(name: str, value: Any) -> bool:
    default = default_plugin(name)
    return isinstance(default, str) and value == (None if default == "none" else {"plugin": default})


def _read(value: Any) -> dict[str, Any]:
    """Return the hashes of files that a component or robot reads besides those of its options."""
    files = value.reads() if isinstance(value, Component | FleetEntry) else ()
    read = [content_hash(file) for file in files if file.is_file()]
    return {"reads": read} if read else {}


def _chosen(value: Any, folder: Path, key: str, ignored: Set[str]) -> Any:
    if isinstance(value, Path):
        return content_hash(value)
    if attrs.has(type(value)):
        named = {"plugin": plugin_name(value, folder)} if isinstance(value, Component) else {}
        return (
            named
            | _read(value)
            | {
                field.alias: _chosen(getattr(value, field.name), folder, f"{key}.{field.alias}", ignored)
                for field in attrs.fields(type(value))
                if field.init and f"{key}.{field.alias}" not in ignored and _differs(value, field)
            }
        )
    if isinstance(value, Mapping):
        return {name: _chosen(inner, folder, key, ignored) for name, inner in value.items()}
    if isinstance(value, frozenset):
        return sorted((_chosen(inner, folder, key, ignored) for inner in value), key=repr)
    if isinstance(value, tuple | list):
        return [_chosen(inner, folder, key, ignored) for inner in value]
    return json_scalar(value)


def _differs(owner: Any, field: Any) -> bool:
    default = default_of(field, owner)
    return default is attrs.NOTHING or bool(getattr(owner, field.name) != default)
