"""Read blocks of Nav2 parameter files, one parameter at a time.

A parameter `scale` of the critic `PathAlign` may be written `PathAlign.scale: 32.0` or nested, at any depth.
"""

import math
from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.yaml import Document, Steps

OF_EVERY_NODE = (
    *("use_sim_time", "qos_overrides", "bond_heartbeat_period", "introspection_mode", "service_introspection_mode"),
    *("action_server_result_timeout", "allow_parameter_qos_overrides", "use_intra_process_comms"),
    "/bond_disable_heartbeat_timeout",
)
"""Parameters of Nav2's nodes that have no effect here."""
_BOOL = dict.fromkeys(("y", "Y", "yes", "Yes", "YES", "on", "On", "ON"), True) | dict.fromkeys(
    ("n", "N", "no", "No", "NO", "off", "Off", "OFF"), False
)
"""Words that ROS 2 reads as a bool and YAML 1.2 as text."""


class _Value(NamedTuple):
    value: Any
    steps: Steps
    shared: bool = False
    """It belongs to no node by name (`/**`), so that another node may be meant."""


class Nav2Block:
    """A block of parameters that records which of them were read, so that the others can be reported at the end.

    Args:
        title: its name in messages, e.g. `FollowPath`.
        data: names and values, nested or dotted.
        document: the file that contains it, if any, and `steps` to it.
    """

    def __init__(
        self, title: str, data: Mapping[str, Any], document: Document | None = None, steps: Steps = ()
    ) -> None:
        self.title = title
        self.document = document
        self._values = _flat(data, steps)
        self._taken: set[str] = set()
        self._not_used: set[str] = set()
        self._within: dict[str, Nav2Block] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._values

    def __len__(self) -> int:
        return len(self._values)

    def add(self, data: Mapping[str, Any], steps: Steps, *, shared: bool) -> None:
        """Add parameters, which win over those that are there; `shared`: they are not this node's by name."""
        self._values |= {name: value._replace(shared=shared) for name, value in _flat(data, steps).items()}

    def within(self, name: str) -> "Nav2Block":
        """Return the parameters that begin with a name and a dot; what is left unread in them is reported, too."""
        if name not in self._within:
            inner = Nav2Block(f"{self.title}.{name}".lstrip("."), {}, self.document)
            inner._values = {key: value._replace(shared=False) for key, value in self._below(name).items()}
            self._within[name] = inner
        return self._within[name]

    def values(self, name: str) -> dict[str, Any]:
        """Return the values of the parameters that begin with a name and a dot, which count as unread."""
        return {key: value.value for key, value in self._below(name).items()}

    def _below(self, name: str) -> dict[str, _Value]:
        start = f"{name}."
        return {key.removeprefix(start): value for key, value in self._values.items() if key.startswith(start)}

    def blocks(self, *, shared: bool = False) -> tuple[str, ...]:
        """Return the names of the blocks in it, or of those that no node has by its name."""
        names = [name for name, value in self._values.items() if "." in name and (value.shared or not shared)]
        return tuple(dict.fromkeys(name.partition(".")[0] for name in names))

    def rename(self, names: Mapping[str, str]) -> None:
        """Give parameters that other releases of Nav2 call otherwise the names of here, unless both are given."""
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
            if below := self._below(name):
                raise self.error(f"expected {_WORDS[kind]}, got a block", f"{name}.{next(iter(below))}")
            return default
        value = self._values[name].value
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if kind is tuple and isinstance(value, list):
            value = tuple(value)
        if kind is bool and isinstance(value, str):
            value = _BOOL.get(value, value)
        right = isinstance(value, kind) and not (kind is int and isinstance(value, bool))
        right = right and not (type(value) is int and abs(value) >= 2**63)
        if not right or (kind is float and not math.isfinite(value)):
            raise self.error(f"expected {_WORDS[kind]}, got {value!r}", name)
        return value

    def take_names(self, name: str) -> tuple[str, ...]:
        """Return a parameter that is a list of names, without empty ones, or () if it is not given.

        Raises:
            InputError: it is not.
        """
        names = self.take(name, tuple, ())
        if not all(isinstance(entry, str) for entry in names):
            raise self.error(f"expected a list of names, got {list(names)!r}", name)
        return tuple(filter(None, names))

    def ignore(self, *names: str) -> None:
        """Accept these parameters, and all below them, or all parameters: others read them, or nothing does."""
        self._taken.update(name for name in self._values if not names or name.partition(".")[0] in names)

    def not_used(self, *names: str) -> None:
        """Accept these parameters of Nav2, and all below them, although they have no effect here."""
        self._not_used.update(names)

    def unused(self, known: Collection[str] = ()) -> tuple[str, ...]:
        """Return the parameters that were not read, and by their names alone the blocks that nothing names.

        Raises:
            InputError: Nav2 does not have some of them; suggest `known` ones.
        """
        unread: dict[str, None] = {}
        unknown = []
        for name, value in self._values.items():
            first, dot, _ = name.partition(".")
            if name in self._taken or value.shared or (first in self._within and (dot or value.value is None)):
                continue
            if name in self._not_used or dot:
                unread[name if name in self._not_used else first] = None
            else:
                unknown.append(name)
        if unknown:
            several = len(unknown) > 1
            names = ", ".join(repr(name) for name in unknown)
            others = {*self._taken, *self._not_used, *known} - self._values.keys()
            hint = "remove them" if several else did_you_mean(unknown[0], others, "remove it: Nav2 does not have it")
            raise self.error(f"unknown parameter{'s' * several} {names}", unknown[0], hint=hint)
        for inner_name, inner in self._within.items():
            unread |= {f"{inner_name}.{name}": None for name in inner.unused()}
        return tuple(unread)

    def error(self, message: str, name: str, hint: str | None = None) -> InputError:
        """Return an InputError with the location of a parameter."""
        words = ": ".join(filter(None, (self.title, "" if message.startswith("unknown") else name, message)))
        if self.document is None:
            return InputError(words, hint=hint)
        steps = self._values[name].steps if name in self._values else ()
        return self.document.error(words, steps, key=True, hint=hint)


_WORDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text", tuple: "a list"}


def _flat(data: Mapping[str, Any], steps: Steps) -> dict[str, _Value]:
    """Return values and their steps by dotted name."""
    values: dict[str, _Value] = {}
    for key, value in data.items():
        here = (*steps, key)
        if isinstance(value, Mapping):
            values |= {f"{key}.{name}": inner for name, inner in _flat(value, here).items()}
        else:
            values[key] = _Value(value, here)
    return values
