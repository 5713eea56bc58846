"""A value of a building file that knows where it stands, so that every mistake is reported with its line."""

from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import Document, Steps

LIMIT = 1e9
"""metres or pixels."""


@attrs.frozen
class Node:
    """One value of the document. The readers raise `InputError` with file and line when it is of another type."""

    document: Document
    value: Any
    steps: Steps = ()

    def fields(self) -> "dict[str, Node]":
        """The values of a mapping (none for an absent or empty one)."""
        if self.value is None:
            return {}
        if not isinstance(self.value, dict):
            raise self.error(f"should be a mapping, not {_kind(self.value)}")
        return {key: Node(self.document, value, (*self.steps, key)) for key, value in self.value.items()}

    def items(self, least: int = 0) -> "list[Node]":
        """The values of a sequence of at least `least` values (none for an absent or empty one)."""
        value = [] if self.value is None else self.value
        if not isinstance(value, list):
            raise self.error(f"should be a sequence, not {_kind(value)}")
        if len(value) < least:
            raise self.error(f"should have at least {least} values, not {len(value)}")
        return [Node(self.document, item, (*self.steps, index)) for index, item in enumerate(value)]

    def section(self, key: str) -> "list[Node]":
        """The items under `key` of this mapping; none if it is absent."""
        inner = self.fields().get(key)
        return [] if inner is None else inner.items()

    def number(self) -> float:
        """A finite number; no building is larger than `LIMIT`."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float) or not abs(self.value) <= LIMIT:
            raise self.error(f"should be a number within ±{LIMIT:g}, not {_kind(self.value)}")
        return float(self.value)

    def integer(self) -> int:
        """A whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self.error(f"should be a whole number, not {_kind(self.value)}")
        return self.value

    def text(self) -> str:
        """A name; the editor writes names that look like numbers without quotes."""
        if self.value is None:
            return ""
        if isinstance(self.value, bool):
            return str(self.value).lower()
        if not isinstance(self.value, str | int | float):
            raise self.error(f"should be text, not {_kind(self.value)}")
        return str(self.value)

    def index(self, count: int, what: str) -> int:
        """The index of a vertex of a level with `count` vertices, named by a `what`."""
        index = self.integer()
        if not 0 <= index < count:
            known = f"the level's vertices are 0 to {count - 1}" if count else "the level has no vertices"
            raise self.error(f"{what} to vertex {index}, but {known}")
        return index

    def error(self, message: str, hint: str | None = None, *, key: bool = False) -> InputError:
        """An error at this value (at its key, with `key`)."""
        return self.document.error(message, self.steps, key=key, hint=hint)


def _kind(value: Any) -> str:
    names = {dict: "a mapping", list: "a sequence", type(None): "nothing"}
    return names.get(type(value), repr(value)[:40])
