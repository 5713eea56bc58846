"""A value of a YAML file with its position, so that every error names its line."""

from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import Document, Steps

LIMIT = 1e9
"""metres or pixels."""


@attrs.frozen
class Node:
    """One value of the document. Its methods raise `InputError` with file and line if it has another type."""

    document: Document
    value: Any
    steps: Steps = ()

    def fields(self) -> "dict[str, Node]":
        """Return the values of a mapping; none if it is absent or empty, which the editor writes as `{}` or `[]`."""
        if self.value in (None, []):
            return {}
        if not isinstance(self.value, dict):
            raise self.error(f"should be a mapping, not {_type_name(self.value)}")
        return {key: Node(self.document, value, (*self.steps, key)) for key, value in self.value.items()}

    def items(self, least: int = 0) -> "list[Node]":
        """Return the values of a sequence, at least `least`; none if it is absent or empty, as `{}` or `[]`."""
        value = [] if self.value in (None, {}) else self.value
        if not isinstance(value, list):
            raise self.error(f"should be a sequence, not {_type_name(value)}")
        if len(value) < least:
            raise self.error(f"should have at least {least} values, not {len(value)}")
        return [Node(self.document, item, (*self.steps, index)) for index, item in enumerate(value)]

    def section(self, key: str) -> "list[Node]":
        """Return the items of the sequence `key` of this mapping; none if it is absent."""
        inner = self.fields().get(key)
        return [] if inner is None else inner.items()

    def number(self) -> float:
        """Return a finite number, at most `LIMIT`."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float) or not abs(self.value) <= LIMIT:
            raise self.error(f"should be a number within ±{LIMIT:g}, not {_type_name(self.value)}")
        return float(self.value)

    def integer(self) -> int:
        """Return a whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self.error(f"should be a whole number, not {_type_name(self.value)}")
        return self.value

    def text(self) -> str:
        """Return a text; a number, which the editor writes without quotes too, as the file spells it."""
        if isinstance(self.value, dict | list):
            raise self.error(f"should be text, not {_type_name(self.value)}")
        return self.document.text(self.steps) or ""

    def index(self, count: int, what: str) -> int:
        """Return the index of a vertex, which a `what` (a lane, a wall) names, on a level with `count` vertices."""
        index = self.integer()
        if not 0 <= index < count:
            known = f"the level's vertices are 0 to {count - 1}" if count else "the level has no vertices"
            raise self.error(f"{what} to vertex {index}, but {known}")
        return index

    def error(self, message: str, hint: str | None = None, *, key: bool = False) -> InputError:
        """Return an error at this value; with `key`, at its key."""
        return self.document.error(message, self.steps, key=key, hint=hint)


def _type_name(value: Any) -> str:
    names = {dict: "a mapping", list: "a sequence", type(None): "nothing"}
    return names.get(type(value), repr(value)[:40])
