"""A world on the command line: `FILE` or `NAME`."""

from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.maps import map_plugin
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.registry import Registry


def world_source(name: str, level: str | None = None) -> WorldSource:
    """Return the source of the world with this name or file.

    Raises:
        InputError: there is no such world.
    """
    loader = map_plugin(Path(name))
    options: dict[str, Any] = {"file": Path(name)} if loader else {}
    if level is not None:
        options["level"] = level
    source: WorldSource = make_component(Registry(WorldSource).get(loader or name), loader or name, options)  # type: ignore[type-abstract]
    return source


def make_component(component: Any, name: str, options: dict[str, Any]) -> Any:
    """Return a component with options from the command line.

    Raises:
        InputError: an option is unknown, missing or wrong.
    """
    fields = {field.name: field for field in attrs.fields(component)}
    for key in options:
        if key not in fields:
            raise InputError(f"{name} has no option {key!r}", hint=f"options: {', '.join(fields) or 'none'}")
    missing = [key for key, field in fields.items() if field.default is attrs.NOTHING and key not in options]
    if missing:
        raise InputError(f"{name} needs {', '.join(missing)}", hint="name its file instead")
    try:
        return component(**options)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error.args[0]}") from None
