"""A run as plain data, which records keep and workers receive: complete, and readable without the plugins.

Defaults are filled in and quantities are SI numbers. A file is its name, relative to the folder of the configuration,
with the hash of its content. An absent component is the word `none`.
"""

import enum
import math
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.content import content_hash
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.shared import Shared
from mrpbench_core.plugins.local import source_of
from mrpbench_core.plugins.provenance import kind_class
from mrpbench_core.plugins.registry import Registry


def canonical(config: RunConfig, folder: Path, shared: Shared | None = None) -> dict[str, Any]:
    """Return a configuration as plain data, with files relative to `folder`; `structure` is the inverse.

    With `shared`, configurations with the same settings get the same data, which is not to be changed.
    """
    shared = shared or Shared()
    return {
        field.name: shared(_setting, getattr(config, field.name), "written_default" in field.metadata, folder)
        for field in attrs.fields(RunConfig)
    }


def canonical_component(component: Component, folder: Path) -> dict[str, Any]:
    """Return one component as `canonical` does."""
    plain: dict[str, Any] = _plain(component, folder)
    return plain


def sources(components: Iterable[Component], folder: Path) -> dict[str, str]:
    """Return the texts of local plugins and of the modules that they import, by name relative to `folder`."""
    texts: dict[str, str] = {}
    for component in components:
        if source := source_of(type(component)):
            texts |= {relative(file, folder): text for file, text in source.files.items()}
    return texts


def plugin_name(component: Component, folder: Path) -> str:
    """Return the name by which a configuration in `folder` chooses a component."""
    return Registry(kind_class(type(component))).name_of(type(component), folder)


def relative(path: Path, folder: Path) -> str:
    """Return the name of a file relative to `folder`."""
    return Path(os.path.relpath(path, folder)).as_posix()


def _plain(value: Any, folder: Path) -> Any:
    if isinstance(value, Path):
        return {"path": relative(value, folder), "sha256": content_hash(value)}
    if attrs.has(type(value)):
        named = {"plugin": plugin_name(value, folder)} if isinstance(value, Component) else {}
        return named | {
            field.alias: _setting(getattr(value, field.name), "written_default" in field.metadata, folder)
            for field in attrs.fields(type(value))
            if field.init
        }
    if isinstance(value, Mapping):
        if value and all(isinstance(inner, Component) for inner in value.values()):
            return [_plain(inner, folder) for inner in value.values()]
        return {key: _plain(inner, folder) for key, inner in value.items()}
    if isinstance(value, frozenset):
        return sorted((_plain(inner, folder) for inner in value), key=repr)
    if isinstance(value, tuple | list):
        return [_plain(inner, folder) for inner in value]
    return json_scalar(value)


def _setting(value: Any, may_be_none: bool, folder: Path) -> Any:
    if may_be_none and value is None:
        return "none"
    if may_be_none and not value:
        return []
    return _plain(value, folder)


def json_scalar(value: Any) -> Any:
    """Return a scalar as a JSON value."""
    if isinstance(value, enum.Enum):
        return value.value
    if isinstance(value, float) and math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    return value
