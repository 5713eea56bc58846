"""The origin of components, which records keep."""

import hashlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.files.text import read_bytes
from mrpbench_core.plugins.checkout import direct_url
from mrpbench_core.plugins.installed import CORE
from mrpbench_core.plugins.local import source_of
from mrpbench_core.plugins.published import PUBLISHED
from mrpbench_core.plugins.registry import Registry


def components_in(value: Any) -> Iterator[Component]:
    """Yield every component in a value (attrs fields, tuples, mappings), recursively, outermost first."""
    if value is None or isinstance(value, bool | int | float | str):
        return
    if isinstance(value, Component):
        yield value
    if attrs.has(type(value)):
        for field in attrs.fields(type(value)):
            yield from components_in(getattr(value, field.name))
    elif isinstance(value, dict):
        for inner in value.values():
            yield from components_in(inner)
    elif isinstance(value, tuple | list):
        for inner in value:
            yield from components_in(inner)


def provenance(value: Any, folder: Path | None = None) -> list[dict[str, Any]]:
    """Return for each class of component in `value` its kind, name and origin.

    The origin is distribution and version, or file and sha256. `direct_url` (PEP 610) is given only for an editable or
    version-controlled installation.
    """
    classes = dict.fromkeys(type(component) for component in components_in(value))
    return [origin(cls, folder) for cls in classes]


def origin(cls: type[Component], folder: Path | None = None) -> dict[str, Any]:
    """Return kind, name and origin of one class."""
    registry = Registry(kind_class(cls))
    facts: dict[str, Any] = {"kind": registry.kind, "name": registry.name_of(cls, folder)}
    if source := source_of(cls):
        return facts | {"file": facts["name"].partition(":")[0], "sha256": source.sha256}
    provider = registry.provider_of(cls)
    if provider is None and (file := getattr(sys.modules.get(cls.__module__), "__file__", None)):
        return facts | {"file": Path(file).name, "sha256": hashlib.sha256(read_bytes(file)).hexdigest()}
    if provider is not None:
        facts |= {"distribution": provider.distribution, "version": provider.version}
        if url := direct_url(provider.distribution):
            facts["direct_url"] = url
    return facts


def title(component: Component) -> str:
    """Kind, name and origin of a component, e.g. `planner 'cbs' of mrpbench-standard 0.1`."""
    facts = origin(type(component))
    owner = f" of {facts['distribution']} {facts['version']}" if "distribution" in facts else ""
    return f"{facts['kind']} '{facts['name']}'{owner}"


def is_of_others(component: Component) -> bool:
    """Tell whether a component is not of this project."""
    provider = Registry(kind_class(type(component))).provider_of(type(component))
    return provider is None or provider.distribution not in (CORE, *PUBLISHED)


def advice_of(cls: type[Component]) -> str | None:
    """Return a line of advice if a class is installed in a group of earlier releases."""
    kind = kind_class(cls)
    provider = Registry(kind).provider_of(cls) if hasattr(kind, "old_groups") else None
    return provider.advice if provider else None


def kind_class(cls: type[Component]) -> type[Component]:
    """Return the class that defines the group of `cls`."""
    return next(owner for owner in cls.__mro__ if "group" in vars(owner))
