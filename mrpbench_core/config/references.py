"""Resolve what a configuration refers to: files, and plugins by name."""

import os
from collections.abc import Mapping
from pathlib import Path

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.content import content_hash
from mrpbench_core.config.hints import to_matrix
from mrpbench_core.config.items import Item
from mrpbench_core.config.maps import map_plugin
from mrpbench_core.config.scalars import Unfit, show
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.plugins.registry import Registry


@attrs.frozen
class References:
    """Files and local plugins of one configuration."""

    folder: Path
    """Folder of the configuration; names of files are relative to it."""
    sources: Mapping[str, str]
    """Texts of local plugins by name of file; the file itself is read for one without a text."""
    verify: bool
    """Refuse a file whose content differs from the hash beside its name."""

    def file(self, item: Item, key: str) -> Path:
        """Return the path of a file that an item names, alone or with its hash.

        Raises:
            InputErrors: the file cannot be read, or has changed.
            Unfit: the item names no file.
        """
        pinned = None
        name = item.value
        if isinstance(name, dict) and set(name) == {"path", "sha256"}:
            name, pinned = name["path"].value, name["sha256"].value
        if not isinstance(name, str) or not name:
            raise Unfit(f"expected the name of a file, got {show(item.value)}")
        path = Path(os.path.normpath(self.folder / name))
        try:
            digest = content_hash(path)
        except InputError as error:
            raise InputErrors(item.location.error(key, f"{error.message}: {path}")) from None
        if self.verify and pinned is not None and pinned != digest:
            raise InputErrors(item.location.error(key, f"has changed since this configuration was written: {path}"))
        return path

    def plugin_of_map(self, chosen: Item, key: str) -> Item:
        """Return the name of the plugin that reads the map that an item names.

        Raises:
            InputErrors: the map cannot be read.
        """
        try:
            return attrs.evolve(chosen, value=map_plugin(Path(os.path.normpath(self.folder / chosen.value))))
        except InputError as error:
            raise InputErrors(chosen.location.error(key, str(error))) from None

    def plugin(self, chosen: Item, kind: type[Component], key: str, default: str | None) -> type[Component]:
        """Return the class that an item names; `default` is the plugin that is chosen where none is named.

        Raises:
            InputErrors: there is no such plugin, or it cannot be used.
        """
        registry = Registry(kind)
        if not isinstance(chosen.value, str) or not chosen.value:
            expected = f"expected the name of a {registry.kind} or a block, got {show(chosen.value)}"
            raise InputErrors(chosen.location.error(key, expected, to_matrix(chosen.value, key)))
        try:
            return registry.get(chosen.value, self.folder, self.sources)
        except InputError as error:
            if error.file is not None:
                raise InputErrors(error) from None
            implicit = chosen.value == default and chosen.location.line is None
            message = error.message + (" (the default)" if implicit else "")
            raise InputErrors(chosen.location.error(key, message, error.hint)) from None


def is_yaml_file(robot: str) -> bool:
    """Tell whether a robot is named by its file."""
    return robot.endswith((".yaml", ".yml"))


def short_name(name: str) -> str:
    """Return the name under which results list a component: no distribution, only the class of a local one."""
    return name.partition("@")[0].rpartition(":")[2]
