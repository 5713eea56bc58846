"""Print one plugin: its description, origin and options."""

import inspect
import re
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api import Metric, hooks
from mrpbench_core.api.component import Component
from mrpbench_core.cli.input.plugin_name import hook_named, resolve
from mrpbench_core.cli.output.table import print_table
from mrpbench_core.plugins.importing import attributed_to
from mrpbench_core.plugins.installed import Provider, load
from mrpbench_core.plugins.provenance import kind_class, origin
from mrpbench_core.plugins.registry import Registry

COLUMN = ("name", "unit", "better", "description", "source")
"""Printed fields of a metric's column."""
MODULES = re.compile(r"\b(?:\w+\.)+(?=[A-Z])")
"""Modules before the name of a class."""


def facts_of(name: str) -> dict[str, Any]:
    """A plugin, given as in `cli.input.plugin_name`, as plain data. This imports it.

    Raises:
        InputError: there is no such plugin, or it cannot be imported.
    """
    if hook := hook_named(name):
        return _facts_of_hook(hook)
    base, plugin = resolve(name)
    cls = Registry(base).get(plugin, Path.cwd())
    with attributed_to(f"{Registry(base).kind} {plugin!r}"):
        return _facts_of_component(cls)


def _facts_of_component(cls: type[Component]) -> dict[str, Any]:
    facts: dict[str, Any] = origin(cls) | {"description": inspect.getdoc(cls) or ""} | _traits(cls)
    if issubclass(cls, Metric):
        facts["columns"] = [{key: getattr(column, key) for key in COLUMN} for column in cls.columns]
    facts["options"] = [_option(field) for field in _fields(cls)]
    return facts


def print_facts(facts: dict[str, Any]) -> None:
    """Print a plugin for people."""
    place = f"{facts['distribution']} {facts['version']}" if "distribution" in facts else facts.get("file", "no file")
    print(f"{facts['kind']} {facts['name']}, from {place}")
    print(facts["description"])
    for key in ("supports", "promises", "requires", "hooks"):
        if key in facts:
            print(f"{key}: {', '.join(facts[key]) or 'nothing'}")
    if "columns" in facts:
        print()
        _print_rows("column", COLUMN, facts["columns"])
    if facts.get("options"):
        print()
        _print_rows("option", ("name", "default", "unit", "type", "help"), facts["options"])
    elif "options" in facts:
        print("\nIt has no options.")


def _facts_of_hook(provider: Provider) -> dict[str, Any]:
    """A hook plugin, and the hooks that it implements."""
    plugin = load(provider)
    described = plugin if inspect.isclass(plugin) or inspect.ismodule(plugin) else type(plugin)
    return {
        "kind": provider.kind,
        "name": provider.name,
        "distribution": provider.distribution,
        "version": provider.version,
        "description": inspect.getdoc(described) or "",
        "hooks": [name for name in vars(hooks) if name.startswith("mrpbench_") and hasattr(plugin, name)],
    }


def _print_rows(first: str, keys: tuple[str, ...], rows: list[dict[str, Any]]) -> None:
    print_table([first, *keys[1:]], [[row[key] for key in keys] for row in rows])


def _fields(cls: Any) -> list[Any]:
    return [field for field in attrs.fields(attrs.resolve_types(cls)) if field.init]


def _option(field: Any) -> dict[str, Any]:
    default = field.default
    if isinstance(default, attrs.Factory):  # type: ignore[arg-type]
        default = "computed" if default.takes_self else default.factory()
    return {
        "name": field.alias,
        "default": "required" if default is attrs.NOTHING else _text(default),
        "unit": field.metadata.get("unit") or "",
        "type": MODULES.sub("", inspect.formatannotation(field.type)),
        "help": field.metadata.get("help", ""),
    }


def _text(default: Any) -> str:
    if isinstance(default, Component):
        return Registry(kind_class(type(default))).name_of(type(default))
    if isinstance(default, tuple):
        return "[" + ", ".join(map(_text, default)) + "]"
    return "none" if default is None else str(getattr(default, "value", default))


def _traits(cls: type[Component]) -> dict[str, list[str]]:
    """Return what a planner or metric declares: features, promises, required channels."""
    traits = {}
    for key in ("supports", "promises", "requires"):
        value = getattr(cls, key, None)
        if isinstance(value, frozenset):
            traits[key] = sorted(str(getattr(entry, "value", entry)) for entry in value)
    return traits
