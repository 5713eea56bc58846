"""Read blocks of Nav2 parameter files (ROS 2 parameter files), one parameter at a time.

A parameter `scale` of the critic `PathAlign` may be written `PathAlign.scale: 32.0` or nested.
"""

import math
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.yaml import Document, Steps, load

PARAMETERS = "ros__parameters"


class Nav2Block:
    """A block of parameters that records which of them were read, so that unknown ones can be reported at the end.

    Args:
        title: its name in messages, e.g. `FollowPath`.
        data: names and values, nested or dotted.
        document: the file that contains it, if any, and `steps` to it.
    """

    def __init__(
        self, title: str, data: Mapping[str, Any], document: Document | None = None, steps: Steps = ()
    ) -> None:
        self.title = title
        self._document = document
        self._values = _flat(data, steps)
        self._taken: set[str] = set()

    def __contains__(self, name: str) -> bool:
        return name in self._values

    def rename(self, names: Mapping[str, str]) -> None:
        """Give parameters that older releases of Nav2 call otherwise the names of today, unless both are given."""
        for old, new in names.items():
            if old in self._values and new not in self._values:
                self._values[new] = self._values.pop(old)

    def take(self, name: str, kind: type, default: Any = None) -> Any:
        """Return a parameter as `kind` (bool, int, float, str or tuple), or `default` if it is not given.

        Raises:
            InputError: it has another type.
        """
        self._taken.add(name)
        if name not in self._values:
            return default
        value = self._values[name][0]
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if kind is tuple and isinstance(value, list):
            value = tuple(value)
        right = isinstance(value, kind) and not (kind is int and isinstance(value, bool))
        right = right and not (type(value) is int and abs(value) >= 2**63)
        if not right or (kind is float and not math.isfinite(value)):
            raise self.error(f"expected {_WORDS[kind]}, got {value!r}", name)
        return value

    def take_names(self, name: str) -> tuple[str, ...]:
        """Return a parameter that is a list of names, or () if it is not given.

        Raises:
            InputError: it is not.
        """
        names = self.take(name, tuple, ())
        if not all(isinstance(entry, str) for entry in names):
            raise self.error(f"expected a list of names, got {list(names)!r}", name)
        return names  # type: ignore[no-any-return]

    def ignore(self, *names: str) -> None:
        """Accept these parameters, and all below them, although they have no effect."""
        for name in self._values:
            if any(name == other or name.startswith(f"{other}.") for other in names):
                self._taken.add(name)

    def refuse_unknown(self, known: Collection[str] = ()) -> None:
        """Raise an InputError that names all parameters that were not read; suggest `known` ones."""
        unknown = [name for name in self._values if name not in self._taken]
        if not unknown:
            return
        several = len(unknown) > 1
        names = ", ".join(repr(name) for name in unknown)
        hint = None if several else did_you_mean(unknown[0], [*self._taken, *known])
        raise self.error(f"unknown parameter{'s' * several} {names}", unknown[0], hint=hint)

    def error(self, message: str, name: str, hint: str | None = None) -> InputError:
        """Return an InputError with the location of a parameter."""
        words = f"{self.title}: {name}: {message}" if not message.startswith("unknown") else f"{self.title}: {message}"
        if self._document is None:
            return InputError(words, hint=hint)
        steps = self._values[name][1] if name in self._values else ()
        return self._document.error(words, steps, key=True, hint=hint)


def nav2_block(file: Path, node: str, *prefix: str) -> Nav2Block | None:
    """Return the parameters of a node or one of its plugins, e.g. `controller_server`, `FollowPath`; None = none.

    Raises:
        InputError: the file cannot be read or is not a ROS 2 parameter file.
    """
    document = load(file)
    steps = _find(document.data, node)
    if steps is None:
        if not _has_parameters(document.data):
            raise document.error(f"is not a ROS 2 parameter file: no {PARAMETERS!r} anywhere")
        return None
    data = document.data
    for step in steps:
        data = data[step]
    for step in prefix:
        steps = (*steps, step)
        if not isinstance(data, dict) or step not in data:
            return None
        data = data[step]
    if not isinstance(data, dict):
        raise document.error("must be a mapping of parameters", steps)
    return Nav2Block(".".join((node, *prefix)), data, document, steps)


_WORDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text", tuple: "a list"}


def _find(data: Any, node: str) -> Steps | None:
    """Return the steps to the parameters of a node, in any namespace."""
    if not isinstance(data, dict):
        return None
    for key, value in data.items():
        if key.rpartition("/")[2] == node and isinstance(value, dict) and PARAMETERS in value:
            return (key, PARAMETERS)
        if key != PARAMETERS and (inner := _find(value, node)) is not None:
            return (key, *inner)
    return None


def _has_parameters(data: Any) -> bool:
    if not isinstance(data, dict):
        return False
    return PARAMETERS in data or any(_has_parameters(value) for value in data.values())


def _flat(data: Mapping[str, Any], steps: Steps) -> dict[str, tuple[Any, Steps]]:
    """Return values and their steps by dotted name."""
    found: dict[str, tuple[Any, Steps]] = {}
    for key, value in data.items():
        here = (*steps, key)
        if isinstance(value, Mapping):
            found |= {f"{key}.{name}": inner for name, inner in _flat(value, here).items()}
        else:
            found[key] = (value, here)
    return found
