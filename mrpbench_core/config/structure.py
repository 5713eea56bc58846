"""Structure items as instances of attrs classes, by the types of their fields, and report every error.

This module replaces a configured cattrs: strict scalars, units, plugins by name, files by content, locations and
validators of single fields would each replace what cattrs does by default.
"""

import enum
import logging
import typing
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from types import UnionType
from typing import Any, Literal, TypeVar, cast

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.api.metric import Metric
from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.containers import Expected, is_block, mapping, sequence, union
from mrpbench_core.config.hints import plugins_with, to_matrix
from mrpbench_core.config.items import Item, Location, from_data
from mrpbench_core.config.maps import SUFFIXES
from mrpbench_core.config.references import References, short_name
from mrpbench_core.config.scalars import Unfit, literal, member, scalar, show
from mrpbench_core.config.sections import metrics_of_sections
from mrpbench_core.config.settings import EXECUTION, WITHOUT_PHYSICS, FleetEntry, RunConfig
from mrpbench_core.config.shared import Shared
from mrpbench_core.config.validation import fault_of, stand_in_of, words_of
from mrpbench_core.files.errors import InputError, InputErrors, in_reading_order, one_line
from mrpbench_core.files.suggestions import suggest
from mrpbench_core.plugins.contract import is_of
from mrpbench_core.plugins.importing import attributed_to, is_interrupt
from mrpbench_core.plugins.provenance import advice_of
from mrpbench_core.plugins.registry import Registry

LOG = logging.getLogger(__name__)
C = TypeVar("C", bound=Component)
_SCALARS = (bool, int, float, str)


class Structure:
    """Structures the items of one configuration. A block that several runs share is structured once."""

    def __init__(self, folder: Path, sources: Mapping[str, str] | None = None, *, verify: bool = True) -> None:
        """See `References` for the arguments."""
        self._references = References(folder, sources or {}, verify)
        self._shared = Shared()
        self._defaults: dict[tuple[str, Any], Item] = {}

    def run(self, root: Item) -> RunConfig:
        """Return one complete configuration.

        Raises:
            InputErrors: everything that is wrong with it, in reading order.
        """
        if not isinstance(root.value, dict):
            raise InputErrors(root.location.error("", f"expected a block of settings, got {show(root.value)}"))
        try:
            config = cast("RunConfig", self._options(root, RunConfig, "", self._with_defaults(root)))
        except InputErrors as several:
            raise InputErrors(*in_reading_order(several.errors)) from None
        added = tuple(name for name in metrics_of_sections(config) if name not in config.metrics)
        if not added:
            return config
        return attrs.evolve(config, metrics=self._shared(self._with_metrics, config.metrics, added))

    def settings(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return some settings of `RunConfig` by name, from plain data.

        Raises:
            InputErrors: what is wrong with one of them.
        """
        fields, self._shared = attrs.fields(RunConfig), Shared()  # no later call has the same items
        return {
            key: self._field(from_data(value, Location()), getattr(fields, key), key) for key, value in values.items()
        }

    def component(self, item: Item, base: type[C], key: str) -> C:
        """Return one component of a kind."""
        return cast("C", self._value(item, Expected(base), key))

    def _with_defaults(self, root: Item) -> dict[str, Item]:
        """Return the settings that the file leaves to the default plugins."""
        blocks = root.value
        planning_only = "simulator" in blocks and blocks["simulator"].value == "none"
        without: tuple[str, ...] = EXECUTION if planning_only else ()
        if "execution" in blocks and blocks["execution"].value == "schedule_only":
            without = WITHOUT_PHYSICS
        added = {}
        for field in attrs.fields(RunConfig):
            default = field.metadata.get("written_default", attrs.NOTHING)
            if field.name in blocks or default is attrs.NOTHING:
                continue
            if field.name in without and isinstance(default, str):
                default = "none"
            if field.name == "assigner" and self._gives_goals(blocks.get("scenario")):
                default = "identity"
            place = attrs.evolve(root.location, line=None, column=None)
            added[field.name] = self._defaults.setdefault((field.name, default), from_data(default, place))
        return added

    def _with_metrics(self, metrics: Mapping[str, Metric], added: Sequence[str]) -> dict[str, Metric]:
        """Return metrics with further ones, as far as these are installed."""
        installed = {provider.name for provider in Registry(Metric)}  # type: ignore[type-abstract]
        items = [from_data(name, Location()) for name in added if name in installed]
        return {**metrics, **{str(item.value): self.component(item, Metric, "metrics") for item in items}}  # type: ignore[type-abstract]

    def _gives_goals(self, scenario: Item | None) -> bool:
        """Tell whether a scenario gives each robot its goal, so that no assigner should change it by default."""
        if scenario is None:
            return False
        try:
            source = self._field(scenario, attrs.fields_dict(RunConfig)["scenario"], "scenario")
        except InputErrors:  # reported with the other settings
            return False
        return bool(source.gives_goals)

    def _value(self, item: Item, expected: Expected, key: str) -> Any:
        result = self._shared(self._attempt, item, expected, key)
        if isinstance(result, InputErrors):
            raise result
        return result

    def _attempt(self, item: Item, expected: Expected, key: str) -> Any:
        """A value, or what is wrong with it."""
        try:
            return self._read(item, expected, key)
        except InputErrors as errors:
            return errors
        except Unfit as error:
            return InputErrors(item.location.error(key, str(error), error.hint or to_matrix(item.value, key, error)))

    def _read(self, item: Item, expected: Expected, key: str) -> Any:
        kind = expected.kind
        origin = typing.get_origin(kind)
        if origin is typing.Annotated:
            return self._read(item, expected._replace(kind=typing.get_args(kind)[0]), key)
        if origin in (typing.Union, UnionType):
            return union(self._value, item, expected, key)
        if origin is Literal:
            return literal(_of_plugin(item, key) if key == "plan_filter" else item.value, kind)
        if origin in (tuple, frozenset, set):
            return sequence(self._value, item, expected, key)
        if origin in (dict, Mapping) or kind in (dict, Mapping):
            return self._mapping(item, expected, key)
        if kind in _SCALARS:
            return scalar(item.value, kind, expected.unit, item.text)
        if kind is Any:
            return item.data
        if kind is Path:
            return self._references.file(item, key)
        if isinstance(kind, type) and issubclass(kind, enum.Enum):
            return member(item.value, kind)
        if isinstance(kind, type) and issubclass(kind, Component):
            return self._component(item, kind, key, expected.default)
        if attrs.has(kind):
            return self._block(item, kind, key)
        raise Unfit(f"has a type that a file cannot express: {kind}")

    def _mapping(self, item: Item, expected: Expected, key: str) -> dict[str, Any]:
        inner = (typing.get_args(expected.kind) or (str, Any))[1]
        if isinstance(inner, type) and issubclass(inner, Component):
            return self._named(item, inner, key)
        return mapping(self._value, item, expected, key)

    def _named(self, item: Item, kind: type[Component], key: str) -> dict[str, Component]:
        """Return a list of components as a dict by name."""
        components = sequence(self._value, item, Expected(tuple[kind, ...]), key)  # type: ignore[valid-type]
        named: dict[str, Component] = {}
        for index, component in enumerate(components):
            name = short_name(Registry(kind).name_of(type(component), self._references.folder))
            if name in named:
                place = item.value[index] if isinstance(item.value, list) else item
                raise InputErrors(place.location.error(f"{key}.{index}", f"{name!r} is listed twice"))
            named[name] = component
        return named

    def _component(self, item: Item, kind: type[Component], key: str, default: str | None) -> Component:
        block = item if isinstance(item.value, dict) else Item({"plugin": item}, item.location, item.key)
        chosen = block.value.get("plugin")
        if chosen is None and default is not None:
            chosen = Item(default, block.location, block.key)
        if chosen is None:
            word = Registry(kind).kind
            raise InputErrors(item.location.error(key, f"names no {word}", f"add `plugin:` with the name of a {word}"))
        options = {name: inner for name, inner in block.value.items() if name != "plugin"}
        if kind is WorldSource and str(chosen.value).endswith(SUFFIXES):
            options["file"], chosen = chosen, self._references.plugin_of_map(chosen, key)
        cls = self._references.plugin(chosen, kind, key, default)
        inner = attrs.evolve(block, value=options)
        if is_of(cls):
            return cast("Component", self._options(inner, cls, key, {}, chosen.value))
        try:
            with attributed_to(
                f"{Registry(kind).kind} {chosen.value!r}"
            ):  # defaults, converters and validators are its code
                return cast("Component", self._options(inner, cls, key, {}, chosen.value))
        except (InputErrors, Unfit):
            raise
        except BaseException as error:
            if is_interrupt(error):
                raise
            raise InputErrors(
                item.location.error(key, f"{chosen.value!r} cannot be made: {one_line(error)}")
            ) from error

    def _block(self, item: Item, kind: type[Any], key: str) -> Any:
        if isinstance(item.value, str) and kind is FleetEntry:
            item = Item({"robot": item}, item.location, item.key)
        if not isinstance(item.value, dict):
            raise Unfit(f"expected a block, got {show(item.value)}")
        return self._options(item, kind, key, {})

    def _options(
        self, item: Item, cls: type[Any], key: str, added: Mapping[str, Item], plugin: str | None = None
    ) -> Any:
        """An instance of `cls` with its fields from `item`; those in `added` where it has none."""
        fields = {field.alias: field for field in attrs.fields(cls) if field.init}
        item = _with_present_names(item, fields, key)
        errors: list[InputError] = []
        values: dict[str, Any] = {}
        for name, inner in item.value.items():
            if name not in fields:
                what = f"unknown option{f' of {plugin!r}' if plugin else ''}" if key else "unknown key"
                hint = (
                    plugins_with(name, cls) if plugin else None if key else self._inside(name, {**added, **item.value})
                )
                hint = hint or suggest(name, fields, "there are" if fields else "it has")
                errors.append(inner.key.error(_join(key, name), what, hint))
        # Validators get a stand-in with the values read so far and the defaults of the others.
        stand_in = stand_in_of(cls)
        for name, field in fields.items():
            inner = item.value.get(name, added.get(name))
            if inner is None:
                if field.default is attrs.NOTHING:
                    errors.append(item.location.error(_join(key, name), "is missing", field.metadata.get("help")))
                continue
            try:
                values[name] = self._field(inner, field, _join(key, name))
                object.__setattr__(stand_in, field.name, values[name])
            except InputErrors as several:
                errors += several.errors
        for name in values:
            if fault := fault_of(stand_in, fields[name], values[name]):
                inner = item.value.get(name, added.get(name))
                errors.append(inner.location.error(_join(key, name), *fault))
        if errors:
            raise InputErrors(*errors)
        try:
            return cls(**values)
        except Exception as error:  # noqa: BLE001 - a plugin's own check of its options
            raise InputErrors(item.location.error(key, words_of(error))) from None

    def _inside(self, name: str, blocks: Mapping[str, Item]) -> str | None:
        """Return the hint for an option that was written outside of its block; None if no block has it."""
        places = []
        for field in attrs.fields(RunConfig):
            for kind in (field.type, *typing.get_args(field.type)):
                if not is_block(kind):
                    continue
                with suppress(InputErrors, Unfit):
                    if issubclass(kind, Component):
                        block = blocks.get(field.name)
                        chosen = block.value.get("plugin") if block and isinstance(block.value, dict) else block
                        default = field.metadata.get("written_default")
                        chosen = chosen or from_data(default if isinstance(default, str) else "none", Location())
                        kind = self._references.plugin(chosen, kind, field.name, None)
                    places += [f"`{field.name}.{name}`"] if name in attrs.fields_dict(kind) else []
        return f"did you mean {' or '.join(places)}?" if places else None

    def _field(self, item: Item, field: Any, key: str) -> Any:
        default = field.metadata.get("written_default", attrs.NOTHING)
        if default is not attrs.NOTHING and item.value is None:
            raise InputErrors(item.location.error(key, "has no value", "write `none` for none"))
        plugin = default if isinstance(default, str) else None
        return self._value(item, Expected(field.type, field.metadata.get("unit"), plugin), key)


def structure(
    canonical: Mapping[str, Any], folder: Path, sources: Mapping[str, str] | None = None, *, verify: bool = True
) -> RunConfig:
    """Return the run that a canonical configuration describes; its files are relative to `folder`.

    Args:
        canonical: from `mrpbench_core.config.canonical`.
        folder: folder of the configuration.
        sources: texts of local plugins by name of file; a file without a text is read.
        verify: refuse files whose content has changed.

    Raises:
        InputErrors: it cannot be run on this installation.
    """
    return Structure(folder, sources, verify=verify).run(from_data(canonical, Location()))


def structure_component(base: type[C], item: Item, key: str, folder: Path) -> C:
    """Return one component outside a study, such as the executor. Advice about its installation is logged.

    Raises:
        InputErrors: everything that is wrong with it.
    """
    try:
        component = Structure(folder).component(item, base, key)
    except InputErrors as several:
        raise InputErrors(*in_reading_order(several.errors)) from None
    if advice := advice_of(type(component)):
        LOG.warning(advice)
    return component


def _with_present_names(item: Item, fields: Mapping[str, Any], key: str) -> Item:
    """Return a block in which each option that has its former name has its present one; log a line of advice."""
    former = {field.metadata.get("former"): name for name, field in fields.items()}
    present = {old: former[old] for old in item.value if old in former and former[old] not in item.value}
    if not present:
        return item
    for old, new in present.items():
        LOG.warning(item.value[old].key.error(_join(key, old), f"is called `{new}` now"))
    return attrs.evolve(item, value={present.get(name, name): inner for name, inner in item.value.items()})


def _of_plugin(item: Item, key: str) -> Any:
    """The value of an option that was a plugin in release 0.2, and may be written so until the next release."""
    if not isinstance(item.value, dict) or item.value.keys() != {"plugin"}:
        return item.value
    name = item.value["plugin"].value
    LOG.warning("%s", item.location.error(key, f"is an option now: write `{key}: {name}`"))
    return name


def _join(key: str, name: str) -> str:
    return f"{key}.{name}" if key else name
