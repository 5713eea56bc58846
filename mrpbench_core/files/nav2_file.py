"""Find the parameters of a node in a Nav2 parameter file, as ROS 2 does (`rcl_yaml_param_parser`, rclcpp).

A file names nodes by their paths, nested or in one key (`robot1/controller_server`), where `*` stands for one name and
`**` for any number of names. All entries that match a node hold, and later ones win.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block
from mrpbench_core.files.yaml import Document, Steps, load

PARAMETERS = "ros__parameters"
T = TypeVar("T")


class _Entry(NamedTuple):
    """The parameters of the nodes that a path names."""

    path: tuple[str, ...]
    parameters: Mapping[str, Any]
    steps: Steps

    @property
    def is_pattern(self) -> bool:
        return any(name in ("*", "**") for name in self.path)

    def matches(self, *names: str) -> bool:
        parts = {"*": "/[^/]+", "**": "(?:/[^/]+)*"}
        pattern = "".join(parts.get(name, "/" + re.escape(name)) for name in self.path)
        return re.fullmatch(pattern, "/" + "/".join(names)) is not None


@attrs.frozen
class Nav2File:
    """A parameter file."""

    document: Document
    _entries: tuple[_Entry, ...]

    @classmethod
    def load(cls, file: Path) -> "Nav2File":
        """Read a file.

        Raises:
            InputError: the file cannot be read or is not a ROS 2 parameter file.
        """
        document = load(file, lenient=True)
        entries = tuple(_entries(document, document.data, (), ()))
        if not entries:
            raise document.error(f"is not a ROS 2 parameter file: no node has {PARAMETERS!r}")
        return cls(document, entries)

    @property
    def nodes(self) -> tuple[str, ...]:
        """The names of the nodes that it names, in any namespace."""
        return tuple(dict.fromkeys(entry.path[-1] for entry in self._entries))

    def namespaces(self, node: str) -> tuple[str, ...]:
        """Return the namespaces in which the file names a node; the node of a costmap has its own below them."""
        names: dict[str, None] = {}
        for entry in self._entries:
            if entry.path[-1] == node and not entry.is_pattern:
                space = entry.path[:-1]
                names["/".join(space[:-1] if space and space[-1] == node else space)] = None
        return tuple(names)

    def node(self, name: str, namespace: str = "") -> Nav2Block | None:
        """Return the parameters of a node in a namespace, or in the only one that has it; None = there are none."""
        spaces = self.namespaces(name)
        space = spaces[0] if len(spaces) == 1 else namespace
        names = (*filter(None, space.split("/")), name)
        if name.endswith("_costmap"):  # its node is in a namespace of its own
            flat = [entry for entry in self._entries if entry.path == names]
            names = (*names, name)
            if flat and not any(entry.path == names for entry in self._entries):
                hint = f"put it below another {name!r}"
                raise self.document.error(
                    f"is of no node: the costmap is {'/'.join(names)!r}", flat[0].steps, hint=hint
                )
        matching = [entry for entry in self._entries if entry.matches(*names)]
        block = Nav2Block(name, {}, self.document)
        for entry in matching:
            block.add(entry.parameters, entry.steps, shared=entry.path[-1] in ("*", "**"))
        return block if matching else None

    def read(
        self, node: str, namespace: str | None, read: Callable[[str], tuple[T, tuple[str, ...]]]
    ) -> tuple[T, tuple[str, ...]]:
        """Return what `read` returns for a namespace, or for each that has a node: values, which are equal, and notes.

        Raises:
            InputError: the namespace does not have the node, or the values differ.
        """
        spaces = self.namespaces(node)
        names = ", ".join(space or "/" for space in spaces)
        if namespace is not None:
            chosen = namespace.strip("/")
            if spaces and chosen not in spaces:
                raise self.document.error(f"has no {node} in the namespace {namespace!r}", hint=f"there are {names}")
            return read(chosen)
        values, notes = zip(*map(read, spaces or ("",)), strict=True)
        if any(other != values[0] for other in values[1:]):
            raise self.document.error(
                f"has different values of {node} in the namespaces {names}", hint="choose one by the option `namespace`"
            )
        return values[0], tuple(dict.fromkeys(note for each in notes for note in each))

    def missing(self, node: str) -> InputError:
        """Return the error that the file has no parameters of a node."""
        return self.document.error(
            f"has no parameters of the node {node!r}", hint=f"it has those of {', '.join(self.nodes)}"
        )


def _entries(document: Document, data: Any, path: tuple[str, ...], steps: Steps) -> list[_Entry]:
    """Return the entries below a path, in the order of the file."""
    entries: list[_Entry] = []
    for key, value in data.items() if isinstance(data, dict) else ():
        here = (*steps, key)
        if key != PARAMETERS:
            below = _entries(document, value, (*path, *filter(None, key.split("/"))), here)
            if isinstance(value, dict) and PARAMETERS in data and not below:
                hint = f"indent it so that it is in {PARAMETERS!r}"
                raise document.error(f"{key} is beside {PARAMETERS!r}, so it is of no node", here, key=True, hint=hint)
            entries += below
        elif path and isinstance(value, dict | None):
            entries.append(_Entry(path, value or {}, here))
        else:
            raise document.error("must be a mapping of parameters below the name of a node", here)
    return entries
