"""Hints for what users often write in another place."""

import difflib
from contextlib import suppress
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.items import Item
from mrpbench_core.config.scalars import Unfit
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import load, providers

MOST = 3
"""Plugins that a hint names."""


def to_matrix(value: Any, key: str, error: Unfit | None = None) -> str | None:
    """Return the hint for a list in the place of one value; None if something else is wrong."""
    if not isinstance(value, list) or not value or (error is not None and not str(error).endswith("got a list")):
        return None
    entries = [entry.data if isinstance(entry, Item) else entry for entry in value]
    words = ", ".join(map(str, entries)) if all(isinstance(entry, str | int | float) for entry in entries) else "…"
    return f"for a run with each, write `matrix: {{{key}: [{words}]}}`"


def plugins_with(option: str, cls: type[Component]) -> str | None:
    """Return the hint that names other plugins of the same kind and package that have an option, similar names first.

    Plugins of other packages are not imported for a hint.
    """
    package = cls.__module__.partition(".")[0]
    name_of_class = next(
        (entry.name for entry in providers(cls.group) if entry.value.endswith(f":{cls.__name__}")), cls.__name__
    )
    names = []
    for provider in providers(cls.group):
        if provider.value.partition(":")[0].partition(".")[0] == package:
            with suppress(InputError):
                names += [provider.name] if option in attrs.fields_dict(load(provider)) else []
    names.sort(key=lambda name: -difflib.SequenceMatcher(None, name_of_class, name).ratio())
    verb = "has it" if len(names) == 1 else "have it"
    return f"{', '.join(names[:MOST])} {verb}" if names else None
