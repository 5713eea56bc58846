"""JSON Schema of a configuration file with the options of installed plugins, for editors.

The schema does not demand required options, because a matrix may contain them; `mrpbench run` reports missing ones.
"""

import enum
import json
import typing
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Literal

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.canonical import json_scalar
from mrpbench_core.config.settings import NOT_IDENTIFYING, FleetEntry, RunConfig
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import robot_names
from mrpbench_core.model.common.units import sizes
from mrpbench_core.plugins.registry import Registry

RANGE = {"type": "string", "pattern": r"^-?[0-9]+\.\.-?[0-9]+$"}
LOCAL = {"type": "string", "pattern": ":", "description": "./file.py:Class or package.module:Class"}
_SCALARS = {bool: "boolean", int: "integer", float: "number", str: "string", Path: "string"}


def schema(without: Sequence[str] = ()) -> dict[str, Any]:
    """Return the schema; plugins that cannot be loaded, and those of some distributions, are left out."""
    return _Schema(without).whole()


def options_schema(cls: type[Any]) -> dict[str, Any]:
    """Return the schema of each option of one component, by name."""
    return _Schema().options(cls)


class _Schema:
    def __init__(self, without: Sequence[str] = ()) -> None:
        self.without = without
        self.definitions: dict[str, Any] = {}

    def whole(self) -> dict[str, Any]:
        settings = self.options(RunConfig)
        name = _axis_name()
        point = {
            "type": "object",
            "description": "values by key, dotted keys for single options",
            "propertyNames": {"pattern": f"^{name}$"},
        }
        axes = {"anyOf": [{"type": "array", "minItems": 1}, RANGE]}
        points = {"anyOf": [{"type": "array", "items": point}, point]}
        matrix = {
            "type": "object",
            "description": "what varies: a list of values, or a range of integers, by key",
            "properties": {"include": points, "exclude": points},
            "additionalProperties": axes,
            "propertyNames": {"pattern": rf"^(include|exclude|\s*{name}\s*(,\s*{name}\s*)*)$"},
        }
        return {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": "mrpbench configuration",
            "type": "object",
            "properties": {**settings, "matrix": matrix},
            "additionalProperties": False,
            "anyOf": [{"required": ["world", "planner"]}, {"required": ["matrix"]}],
            "$defs": self.definitions,
        }

    def options(self, cls: type[Any]) -> dict[str, Any]:
        """Return the schema of each option of a class, by name."""
        return {field.alias: self._option(field) for field in attrs.fields(cls) if field.init}

    def _option(self, field: Any) -> dict[str, Any]:
        written = field.metadata.get("written_default", attrs.NOTHING)
        plugin, may_be_empty = written if isinstance(written, str) else None, written is attrs.NOTHING
        schema = self.value(field.type, field.metadata.get("unit"), plugin, may_be_empty=may_be_empty)
        if field.metadata.get("help"):
            schema = {**schema, "description": field.metadata["help"]}
        default = written if written is not attrs.NOTHING else field.default
        if default is not attrs.NOTHING and isinstance(default, bool | int | float | str | enum.Enum):
            schema = {**schema, "default": json_scalar(default)}
        return schema

    def value(
        self, kind: Any, unit: str | None = None, default: str | None = None, *, may_be_empty: bool = True
    ) -> dict[str, Any]:
        """Return the schema of a value of type `kind`.

        Args:
            kind: its type.
            unit: of a number.
            default: the plugin of a block that names none.
            may_be_empty: an empty value says `none`; for a whole stage it is refused as a slip.
        """
        origin, arguments = typing.get_origin(kind), typing.get_args(kind)
        if origin in (typing.Union, UnionType):
            empty = [None] if may_be_empty else []
            nothing = [{"enum": [*empty, "none"]}] if NoneType in arguments else []
            members = [self.value(member, unit, default) for member in arguments if member is not NoneType]
            return {"anyOf": [*members, *nothing]}
        if origin is Literal:
            return {"enum": list(arguments)}
        if origin in (tuple, frozenset, set):
            return self._sequence(arguments, fixed=origin is tuple and arguments[-1:] != (...,), unit=unit)
        if origin in (dict, Mapping):
            return self._mapping(arguments[1])
        if kind in (int, float) and unit is not None:
            units = "|".join(sorted(sizes(unit), key=len, reverse=True)).replace("^", r"\^")
            text = {"type": "string", "pattern": rf"^[-+.0-9eE]+(/[0-9]+)?( ?({units}))?$"}
            return {"anyOf": [{"type": _SCALARS[kind]}, text], "examples": [f"1 {unit}"]}
        if kind in _SCALARS:
            return {"type": _SCALARS[kind]}
        if isinstance(kind, type) and issubclass(kind, enum.Enum):
            return {"enum": [member.value for member in kind]}
        if isinstance(kind, type) and issubclass(kind, Component):
            return self._component(kind, default)
        if attrs.has(kind):
            options = self.options(kind)
            block = {"type": "object", "properties": options, "additionalProperties": False}
            if kind is not FleetEntry:
                return block
            robot = {"anyOf": [{"enum": list(robot_names())}, {"type": "string", "pattern": r"\.ya?ml$"}]}
            options["robot"] |= robot
            return {"anyOf": [robot, block]}
        return {}

    def _sequence(self, arguments: tuple[Any, ...], *, fixed: bool, unit: str | None) -> dict[str, Any]:
        if fixed:
            entries = [self.value(entry, unit) for entry in arguments]
            return {"type": "array", "prefixItems": entries, "minItems": len(entries), "maxItems": len(entries)}
        entry = self.value(arguments[0], unit)
        several = {"type": "array", "items": entry}
        kind = arguments[0]
        single = isinstance(kind, type) and (issubclass(kind, Component) or attrs.has(kind))
        return {"anyOf": [several, entry]} if single else several

    def _mapping(self, kind: Any) -> dict[str, Any]:
        if isinstance(kind, type) and issubclass(kind, Component):
            return self._sequence((kind,), fixed=False, unit=None)
        return {"type": "object", "additionalProperties": self.value(kind)}

    def _component(self, kind: type[Component], default: str | None) -> dict[str, Any]:
        name = kind.group + (f":{kind.__qualname__}" if "group" not in vars(kind) else "")
        if name not in self.definitions:
            self.definitions[name] = {}  # ends the recursion for a plugin that contains its own kind
            self.definitions[name] = self._choice(kind)
        reference = {"$ref": f"#/$defs/{name}"}
        classes = _classes(kind, self.without)
        if default not in classes:
            return reference
        unnamed = {
            "type": "object",
            "properties": self.options(classes[default]),
            "additionalProperties": False,
            "title": f"options of {default}",
        }
        return {"anyOf": [reference, unnamed]}

    def _choice(self, kind: type[Component]) -> dict[str, Any]:
        """Return the schema of a plugin: its name, or a block with its name and options."""
        blocks: dict[str, dict[str, Any]] = {}
        for name, cls in _classes(kind, self.without).items():
            with suppress(Exception, SystemExit):  # help, defaults and types may be code of the plugin
                blocks[name] = self._block(name, cls)
        local = {"type": "object", "properties": {"plugin": LOCAL}, "required": ["plugin"]}
        maps = [{"type": "string", "pattern": r"\.(map|ya?ml)$"}] if kind is WorldSource else []
        return {"oneOf": [{"enum": list(blocks)}, LOCAL, *maps, *blocks.values(), local]}

    def _block(self, name: str, cls: type[Component]) -> dict[str, Any]:
        """Return the schema of a plugin with its options."""
        schema = {
            "type": "object",
            "title": name,
            "description": (cls.__doc__ or "").partition("\n")[0],
            "properties": {"plugin": {"const": name}, **self.options(cls)},
            "required": ["plugin"],
            "additionalProperties": False,
        }
        json.dumps(schema)
        return schema


def _axis_name() -> str:
    """The pattern of a key that may vary. Options of plugins are not checked, because local plugins may have any."""
    patterns = []
    for field in attrs.fields(RunConfig):
        kind, key = field.type, field.name
        if key in NOT_IDENTIFYING:
            continue
        if isinstance(kind, type) and attrs.has(kind) and not issubclass(kind, Component):
            names = [inner.alias for inner in attrs.fields(kind) if f"{key}.{inner.alias}" not in NOT_IDENTIFYING]
            patterns.append(rf"{key}(\.({'|'.join(names)}))?")
        else:
            patterns.append(key if kind in _SCALARS else rf"{key}(\.[^,]+)?")
    return f"({'|'.join(patterns)})"


def _classes(kind: type[Component], without: Sequence[str]) -> dict[str, type[Component]]:
    """Return the installed components of a kind that can be loaded, without those of some distributions."""
    registry = Registry(kind)
    providers = [provider for provider in registry if provider.distribution not in without]
    names = [provider.name for provider in providers]
    classes = {}
    for provider in providers:
        clash = names.count(provider.name) > 1
        name = f"{provider.name}@{provider.distribution}" if clash else provider.name
        try:
            classes[name] = registry.get(name)
        except InputError:
            continue
    return classes
