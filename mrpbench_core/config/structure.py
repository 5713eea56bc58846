"""From items to attrs classes, as their fields' types say, with every mistake reported.

Written instead of configuring cattrs: strict scalars, units, plugins by name, files by content, marks and validators
per field would each replace what cattrs does by default.
"""

import enum
import os
import types
import typing
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal, TypeVar, cast

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.content import content_hash
from mrpbench_core.config.items import Item, Where, from_data
from mrpbench_core.config.mistakes import Mistakes, did_you_mean, in_reading_order
from mrpbench_core.config.scalars import Unfit, describe, literal, member, scalar, show
from mrpbench_core.config.settings import EXECUTION, FleetEntry, RunConfig
from mrpbench_core.config.validation import fault_of, stand_in_of, words_of
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.plugins.registry import Registry

C = TypeVar("C", bound=Component)
_SCALARS = (bool, int, float, str)


class Structure:
    """Structures items whose files and local plugins lie in one folder. Blocks shared by runs are structured once."""

    def __init__(self, folder: Path, sources: Mapping[str, str] | None = None, *, verify: bool = True) -> None:
        """With `verify`, a file whose content differs from the hash beside its name is refused."""
        self.folder = folder
        self.sources = sources or {}
        self.verify = verify
        self._done: dict[tuple[int, Any, str], tuple[Item, Any]] = {}
        self._defaults: dict[tuple[str, Any], Item] = {}

    def run(self, root: Item) -> RunConfig:
        """One complete configuration.

        Raises:
            Mistakes: all that is wrong with it.
        """
        if not isinstance(root.value, dict):
            raise Mistakes(root.where.error("", f"expected a block of settings, got {show(root.value)}"))
        return cast("RunConfig", self._options(root, RunConfig, "", self._with_defaults(root)))

    def component(self, item: Item, base: type[C], key: str) -> C:
        """One component of a kind."""
        return cast("C", self._value(item, base, key, None))

    def _with_defaults(self, root: Item) -> dict[str, Item]:
        """The settings that the file leaves to plugins chosen by default."""
        given = root.value
        planning_only = "simulator" in given and given["simulator"].value == "none"
        added = {}
        for field in attrs.fields(RunConfig):
            default = field.metadata.get("written_default", attrs.NOTHING)
            if field.name in given or default is attrs.NOTHING:
                continue
            if planning_only and field.name in EXECUTION:
                default = "none"
            place = attrs.evolve(root.where, line=None, column=None)
            added[field.name] = self._defaults.setdefault((field.name, default), from_data(default, place))
        return added

    def _value(self, item: Item, kind: Any, key: str, unit: str | None, default: str | None = None) -> Any:
        known = (id(item), kind, key)
        if known not in self._done:
            try:
                result = self._read(item, kind, key, unit, default)
            except Mistakes as mistakes:
                result = mistakes
            except Unfit as error:
                result = Mistakes(item.where.error(key, str(error), error.hint))
            self._done[known] = (item, result)  # the item is kept, so that its id stays its own
        result = self._done[known][1]
        if isinstance(result, Mistakes):
            raise result
        return result

    def _read(self, item: Item, kind: Any, key: str, unit: str | None, default: str | None) -> Any:
        origin = typing.get_origin(kind)
        if origin is typing.Annotated:
            return self._read(item, typing.get_args(kind)[0], key, unit, default)
        if origin in (typing.Union, types.UnionType):
            return self._union(item, kind, key, unit, default)
        if origin is Literal:
            return literal(item.value, kind)
        if origin in (tuple, frozenset, set):
            return self._sequence(item, kind, key, unit)
        if origin in (dict, Mapping) or kind in (dict, Mapping):
            return self._mapping(item, kind, key, unit)
        if kind in _SCALARS:
            return scalar(item.value, kind, unit)
        if kind is Any:
            return item.data
        if kind is Path:
            return self._file(item, key)
        if isinstance(kind, type) and issubclass(kind, enum.Enum):
            return member(item.value, kind)
        if isinstance(kind, type) and issubclass(kind, Component):
            return self._component(item, kind, key, default)
        if attrs.has(kind):
            return self._block(item, kind, key)
        raise Unfit(f"has a type that a file cannot express: {kind}")

    def _union(self, item: Item, kind: Any, key: str, unit: str | None, default: str | None) -> Any:
        members = [member for member in typing.get_args(kind) if member is not types.NoneType]
        optional = len(members) < len(typing.get_args(kind))
        if optional and (item.value is None or (item.value == "none" and not _takes_text(members))):
            return None
        if isinstance(item.value, str) and str in members and Path in members:
            members.remove(str if is_path(item.value) else Path)
        if len(members) == 1:
            return self._value(item, members[0], key, unit, default)
        members.sort(key=lambda member: member is not type(item.value))
        failures = []
        for choice in members:
            try:
                return self._value(item, choice, key, unit, default)
            except Mistakes as mistakes:
                failures.append((choice, mistakes))
        fitting = [mistakes for choice, mistakes in failures if _holds(choice, type(item.value))]
        if len(fitting) == 1:
            raise fitting[0]
        expected = " or ".join(_describe_choice(choice, unit) for choice in members)
        raise Unfit(f"expected {expected}, got {show(item.value)}")

    def _sequence(self, item: Item, kind: Any, key: str, unit: str | None) -> Any:
        origin, arguments = typing.get_origin(kind), typing.get_args(kind)
        many = origin is not tuple or arguments[-1:] == (...,)
        entries = item.value
        if many and not isinstance(entries, list) and _is_block(arguments[0]) and isinstance(entries, str | dict):
            entries = [item]  # a single block needs no list around it
        if not isinstance(entries, list):
            raise Unfit(f"expected a list, got {show(item.value)}")
        if not many and len(entries) != len(arguments):
            raise Unfit(f"expected {len(arguments)} entries, got {len(entries)}")
        kinds = [arguments[0]] * len(entries) if many else list(arguments)
        values = self._collect(
            [
                (entry, inner, key if entry is item else f"{key}.{index}")
                for index, (entry, inner) in enumerate(zip(entries, kinds, strict=True))
            ],
            unit,
        )
        return tuple(values) if origin is tuple else frozenset(values)

    def _mapping(self, item: Item, kind: Any, key: str, unit: str | None) -> dict[str, Any]:
        _, inner = typing.get_args(kind) or (str, Any)
        if isinstance(inner, type) and issubclass(inner, Component):
            return self._named(item, inner, key)
        if not isinstance(item.value, dict):
            raise Unfit(f"expected a block, got {show(item.value)}")
        values = self._collect([(entry, inner, f"{key}.{name}") for name, entry in item.value.items()], unit)
        return dict(zip(item.value, values, strict=True))

    def _named(self, item: Item, kind: type[Component], key: str) -> dict[str, Component]:
        """A list of components, by name."""
        components = self._sequence(item, tuple[kind, ...], key, None)  # type: ignore[valid-type]
        named: dict[str, Component] = {}
        for index, component in enumerate(components):
            name = short_name(Registry(kind).name_of(type(component), self.folder))
            if name in named:
                place = item.value[index] if isinstance(item.value, list) else item
                raise Mistakes(place.where.error(f"{key}.{index}", f"{name!r} is listed twice"))
            named[name] = component
        return named

    def _collect(self, parts: list[tuple[Item, Any, str]], unit: str | None) -> list[Any]:
        """Structure each part; all mistakes at once."""
        values: list[Any] = []
        errors: list[InputError] = []
        for item, kind, key in parts:
            try:
                values.append(self._value(item, kind, key, unit))
            except Mistakes as mistakes:
                errors += mistakes.errors
        if errors:
            raise Mistakes(*errors)
        return values

    def _file(self, item: Item, key: str) -> Path:
        pinned = None
        name = item.value
        if isinstance(name, dict) and set(name) == {"path", "sha256"}:
            name, pinned = name["path"].value, name["sha256"].value
        if not isinstance(name, str) or not name:
            raise Unfit(f"expected the name of a file, got {show(item.value)}")
        path = Path(os.path.normpath(self.folder / name))
        try:
            found = content_hash(path)
        except InputError as error:
            raise Mistakes(item.where.error(key, f"{error.message}: {path}")) from None
        if self.verify and pinned is not None and pinned != found:
            raise Mistakes(item.where.error(key, f"has changed since this configuration was written: {path}"))
        return path

    def _component(self, item: Item, kind: type[Component], key: str, default: str | None) -> Component:
        registry = Registry(kind)
        block = item if isinstance(item.value, dict) else Item({"plugin": item}, item.where, item.key)
        chosen = block.value.get("plugin")
        if chosen is None and default is not None:
            chosen = Item(default, block.where, block.key)
        if chosen is None:
            raise Mistakes(
                item.where.error(key, f"names no {registry.kind}", f"add `plugin:` with a {registry.kind}'s name")
            )
        if not isinstance(chosen.value, str) or not chosen.value:
            expected = f"expected the name of a {registry.kind} or a block, got {show(chosen.value)}"
            raise Mistakes(chosen.where.error(key, expected))
        try:
            cls = registry.get(chosen.value, self.folder, self.sources)
        except InputError as error:
            if error.file is not None:
                raise Mistakes(error) from None
            unsaid = chosen.value == default and chosen.where.line is None
            raise Mistakes(chosen.where.error(key, error.message + " (the default)" * unsaid, error.hint)) from None
        options = {name: inner for name, inner in block.value.items() if name != "plugin"}
        return cast("Component", self._options(attrs.evolve(block, value=options), cls, key, {}, chosen.value))

    def _block(self, item: Item, kind: type[Any], key: str) -> Any:
        if isinstance(item.value, str) and kind is FleetEntry:
            item = Item({"robot": item}, item.where, item.key)
        if not isinstance(item.value, dict):
            raise Unfit(f"expected a block, got {show(item.value)}")
        return self._options(item, kind, key, {})

    def _options(
        self, item: Item, cls: type[Any], key: str, added: Mapping[str, Item], plugin: str | None = None
    ) -> Any:
        """An instance of `cls` with its fields from `item`; those in `added` where it has none."""
        fields = {field.alias: field for field in attrs.fields(cls) if field.init}
        errors: list[InputError] = []
        values: dict[str, Any] = {}
        for name, inner in item.value.items():
            if name not in fields:
                owner = f" of {plugin!r}" if plugin else ""
                hint = did_you_mean(name, fields, "there are" if fields else "it has")
                errors.append(
                    inner.key.error(_join(key, name), f"unknown option{owner}" if key else "unknown key", hint)
                )
        # A stand-in that validators may look at, with the values read so far and the defaults of the others.
        stand_in = stand_in_of(cls)
        for name, field in fields.items():
            inner = item.value.get(name, added.get(name))
            if inner is None:
                if field.default is attrs.NOTHING:
                    errors.append(item.where.error(_join(key, name), "is missing", field.metadata.get("help")))
                continue
            try:
                values[name] = self._field(inner, field, _join(key, name))
                object.__setattr__(stand_in, field.name, values[name])
            except Mistakes as mistakes:
                errors += mistakes.errors
        for name in values:
            if fault := fault_of(stand_in, fields[name], values[name]):
                inner = item.value.get(name, added.get(name))
                errors.append(inner.where.error(_join(key, name), *fault))
        if errors:
            raise Mistakes(*errors)
        try:
            return cls(**values)
        except Exception as error:  # noqa: BLE001 - a plugin's own check of its options
            raise Mistakes(item.where.error(key, words_of(error))) from None

    def _field(self, item: Item, field: Any, key: str) -> Any:
        default = field.metadata.get("written_default", attrs.NOTHING)
        if default is not attrs.NOTHING and item.value is None:
            raise Mistakes(item.where.error(key, "has no value", "write `none` for none"))
        return self._value(
            item, field.type, key, field.metadata.get("unit"), default if isinstance(default, str) else None
        )


def structure(
    canonical: Mapping[str, Any], folder: Path, sources: Mapping[str, str] | None = None, *, verify: bool = True
) -> RunConfig:
    """The run that a canonical configuration describes; its files lie relative to `folder`.

    Args:
        canonical: from `mrpbench_core.config.canonical`.
        folder: the configuration's folder.
        sources: texts of local plugins by name of file; without one, the file itself is read.
        verify: refuse files whose content has changed.

    Raises:
        InputErrors: it cannot be run here.
    """
    try:
        return Structure(folder, sources, verify=verify).run(from_data(canonical, Where()))
    except Mistakes as mistakes:
        raise InputErrors(in_reading_order(mistakes.errors)) from None


def structure_component(base: type[C], item: Item, key: str, folder: Path) -> C:
    """One component outside a study, such as the executor.

    Raises:
        InputErrors: what is wrong with it.
    """
    try:
        return Structure(folder).component(item, base, key)
    except Mistakes as mistakes:
        raise InputErrors(in_reading_order(mistakes.errors)) from None


def is_path(robot: str) -> bool:
    """Tell a robot's file from its name."""
    return robot.endswith((".yaml", ".yml"))


def short_name(name: str) -> str:
    """The name under which results list a component: without distribution, of a local one the class."""
    return name.partition("@")[0].rpartition(":")[2]


def _join(key: str, name: str) -> str:
    return f"{key}.{name}" if key else name


def _takes_text(members: list[Any]) -> bool:
    return any(member is str or "none" in typing.get_args(member) for member in members)


def _is_block(kind: Any) -> bool:
    return isinstance(kind, type) and (issubclass(kind, Component) or attrs.has(kind))


def _holds(kind: Any, container: type) -> bool:
    """Tell whether a dict or list is the form in which values of `kind` are written."""
    if container is dict:
        return _is_block(kind)
    return container is list and typing.get_origin(kind) in (tuple, frozenset)


def _describe_choice(kind: Any, unit: str | None) -> str:
    if typing.get_origin(kind) is Literal:
        return " or ".join(str(choice) for choice in typing.get_args(kind))
    if typing.get_origin(kind) is tuple:
        return "a list"
    return "a block" if _is_block(kind) else describe(kind, unit)
