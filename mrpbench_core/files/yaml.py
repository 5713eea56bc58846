"""Strict YAML 1.2 with line marks.

It accepts the data of JSON, and comments, anchors and infinite numbers. Scalars follow the core schema of YAML 1.2.2
§10.3 (`1e-3` is a number, `on` and `10:30` are text, `010` is ten), while PyYAML itself follows YAML 1.1. Keys are text
as written. Tags, merge keys, duplicate keys and several documents are errors; `lenient` readers, for files of other
programs, merge keys and accept a key twice with the same value, or once empty. Depth and alias expansion are bounded,
and nothing recurses, so that no input can exhaust stack or memory.
"""

import math
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs
import yaml

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text, refuse_control_characters

DEPTH_LIMIT = 100
"""Nested sequences and mappings, aliases expanded."""
ALIAS_LIMIT = 100_000
"""Values that aliases add to a document."""

Steps = tuple[str | int, ...]
"""Keys and indices from the root of a document to a value."""

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_INT = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
_CONFLICT = re.compile(r"^<{7} ", re.MULTILINE)
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_NAMED: dict[str, Any] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL"), None),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"), math.inf),
    **dict.fromkeys(("-.inf", "-.Inf", "-.INF"), -math.inf),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
}


class _Place:
    """The location of a value, and those of all values inside it."""

    __slots__ = ("column", "inside", "key", "line", "text")

    def __init__(self, mark: Any, text: str | None = None) -> None:
        self.line: int = mark.line + 1
        self.column: int = mark.column + 1
        self.text = text  # of a scalar that is not empty
        self.key: _Place | None = None
        self.inside: dict[str | int, _Place] = {}


@attrs.frozen
class Document:
    """The data of a file with their locations."""

    data: Any
    """dict (text keys), list, str, int, float, bool or None. Aliased values are one object."""
    file: Path | None
    _root: _Place = attrs.field(repr=False, eq=False)

    def mark(self, steps: Steps = (), *, key: bool = False) -> tuple[int, int]:
        """Line and column, from 1, of the value (or, with `key`, of its key) at `steps`.

        If the document has no such value, the location is that of the innermost existing value around it.
        """
        place = self._root
        for index, step in enumerate(steps):
            inner = place.inside.get(step)
            if inner is None:
                break
            place = inner
            if key and index == len(steps) - 1 and place.key is not None:
                place = place.key
        return place.line, place.column

    def text(self, steps: Steps) -> str | None:
        """Return the scalar at `steps` as the file spells it (`1.10`, `007`); None if it is empty or not a scalar."""
        place = self._root
        for step in steps:
            place = place.inside[step]
        return place.text

    def error(self, message: str, steps: Steps = (), *, key: bool = False, hint: str | None = None) -> InputError:
        """Return an InputError with the location at `steps`; see `mark`."""
        line, column = self.mark(steps, key=key)
        return InputError(message, file=self.file, line=line, column=column, hint=hint)


def load(path: Path | str, *, lenient: bool = False) -> Document:
    """Read a file.

    Raises:
        InputError: it cannot be read or is not strict YAML; the error names file, line and column.
    """
    return loads(read_text(path), file=path, lenient=lenient)


def loads(text: str, *, file: Path | str | None = None, lenient: bool = False) -> Document:
    """Read a text; errors name `file`."""
    refuse_control_characters(text, file)
    return _DocumentReader(None if file is None else Path(file), lenient).read(text)


def plain_scalar(text: str) -> Any:
    """Return the value of a plain (unquoted) scalar.

    Raises:
        ValueError: a number that a float of 64 bits cannot hold.
    """
    if text in _NAMED:
        return _NAMED[text]
    if _INT.fullmatch(text):
        number = int(text, {"0o": 8, "0x": 16}.get(text[:2], 10))
        if abs(number) > sys.float_info.max:  # no option is that large, and `float` would fail
            raise ValueError(text)
        return number
    if _FLOAT.fullmatch(text):
        real = float(text)
        if math.isinf(real):
            raise ValueError(text)
        return real
    return text


class _Frame:
    """A sequence or mapping being read."""

    __slots__ = ("height", "key", "merged", "open", "place", "size", "value")

    def __init__(self, value: Any, place: _Place) -> None:
        self.value = value
        self.place = place
        self.key: Any = None  # event of the key whose value comes next
        self.open = isinstance(value, dict | list)
        self.merged: list[_Frame] = []  # what its merge key adds
        self.size = 1  # values in it, aliases expanded
        self.height = 1 if self.open else 0


class _DocumentReader:
    def __init__(self, file: Path | None, lenient: bool) -> None:
        self.file = file
        self.lenient = lenient
        self.anchors: dict[str, _Frame] = {}
        self.stack: list[_Frame] = []
        self.root: _Frame | None = None
        self.expanded = 0

    def read(self, text: str) -> Document:
        for event in self._events(text):
            kind = type(event)
            if kind is yaml.ScalarEvent:
                self._scalar(event)
            elif kind is yaml.MappingStartEvent:
                self._open({}, event)
            elif kind is yaml.SequenceStartEvent:
                self._open([], event)
            elif kind is yaml.MappingEndEvent or kind is yaml.SequenceEndEvent:
                self._close()
            elif kind is yaml.AliasEvent:
                self._alias(event)
            elif kind is yaml.DocumentStartEvent:
                self._begin(event)
        if self.root is None:
            raise InputError("is empty", file=self.file)
        return Document(self.root.value, self.file, self.root.place)

    def _events(self, text: str) -> Iterator[Any]:
        try:
            yield from yaml.parse(text, Loader=_LOADER)
        except yaml.MarkedYAMLError as error:
            if conflict := _CONFLICT.search(text):
                line, sides = text.count("\n", 0, conflict.start()) + 1, "keep one of its two sides"
                raise InputError("has a merge conflict of Git", file=self.file, line=line, hint=sides) from None
            mark = error.problem_mark or error.context_mark
            hint = error.context
            if hint and error.context_mark and mark and error.context_mark.line != mark.line:
                hint += f" that begins in line {error.context_mark.line + 1}"
            raise self._error(error.problem or "is not YAML", mark, hint) from None
        except (yaml.YAMLError, ValueError, OverflowError) as error:  # the last two occur without libyaml
            raise self._error(f"is not YAML: {' '.join(str(error).split())}", None) from None

    def _begin(self, event: Any) -> None:
        if self.root is not None:
            raise self._error("a second document begins here; only one is allowed", event.start_mark)
        if event.version not in (None, (1, 2)):
            raise self._error("only YAML 1.2 is supported", event.start_mark)

    def _scalar(self, event: Any) -> None:
        self._check(event)
        text = event.value
        frame = self.stack[-1] if self.stack else None
        if frame is not None and frame.key is None and type(frame.value) is dict:
            if event.anchor:
                self.anchors[event.anchor] = _Frame(text, _Place(event.start_mark, text))
            self._key(frame, text, event)
            return
        value = text
        if event.implicit[0]:
            try:
                value = plain_scalar(text)
            except ValueError:
                raise self._error("this number is too large", event.start_mark) from None
        leaf = _Frame(value, _Place(event.start_mark, None if value is None else text))
        if event.anchor:
            self.anchors[event.anchor] = leaf
        self._put(leaf)

    def _key(self, frame: _Frame, text: str, event: Any) -> None:
        if text == "<<" and event.implicit[0] and not self.lenient:
            raise self._error("merge keys are not supported; repeat the keys", event.start_mark)
        if text in frame.value and not self.lenient:
            raise self._duplicate(frame, event)
        frame.key = event

    def _duplicate(self, frame: _Frame, event: Any) -> InputError:
        first = frame.place.inside[event.value].key
        hint = None if first is None else f"first in line {first.line}; keep one of them"
        return self._error(f"duplicate key {event.value!r}", event.start_mark, hint)

    def _merge(self, frame: _Frame) -> None:
        """Add the keys of merged mappings that a mapping does not have itself."""
        for mapping in frame.merged:
            for key, value in mapping.value.items():
                if key not in frame.value:
                    frame.value[key] = value
                    frame.place.inside[key] = mapping.place.inside[key]

    def _open(self, value: Any, event: Any) -> None:
        self._check(event)
        self._refuse_as_key(event)
        frame = _Frame(value, _Place(event.start_mark))
        if event.anchor:
            self.anchors[event.anchor] = frame
        self._check_depth(len(self.stack) + 1, event)
        self.stack.append(frame)

    def _close(self) -> None:
        frame = self.stack.pop()
        frame.open = False
        self._merge(frame)
        self._put(frame)

    def _alias(self, event: Any) -> None:
        anchored = self.anchors.get(event.anchor)
        if anchored is None:
            raise self._error(f"alias '*{event.anchor}' names no anchor above it", event.start_mark)
        if anchored.open:
            raise self._error(f"alias '*{event.anchor}' contains itself", event.start_mark)
        self._refuse_as_key(event)
        self._check_depth(len(self.stack) + anchored.height, event)
        self.expanded += anchored.size
        if self.expanded > ALIAS_LIMIT:
            raise self._error(f"aliases add more than {ALIAS_LIMIT} values", event.start_mark)
        copy = _Frame(anchored.value, _Place(event.start_mark, anchored.place.text))
        copy.open, copy.size, copy.height = False, anchored.size, anchored.height
        copy.place.inside = anchored.place.inside
        self._put(copy)

    def _put(self, done: _Frame) -> None:
        """Store a finished value in its container."""
        if not self.stack:
            self.root = done
            return
        frame = self.stack[-1]
        frame.size += done.size
        frame.height = max(frame.height, done.height + 1)
        if type(frame.value) is dict:
            key = frame.key
            frame.key = None
            if key.value == "<<" and key.implicit[0]:
                frame.merged += self._mappings(done, key)
                return
            if frame.value.get(key.value) is not None:
                if done.value is not None and done.value != frame.value[key.value]:
                    raise self._duplicate(frame, key)
                return
            done.place.key = _Place(key.start_mark)
            frame.value[key.value] = done.value
            frame.place.inside[key.value] = done.place
        else:
            frame.place.inside[len(frame.value)] = done.place
            frame.value.append(done.value)

    def _mappings(self, done: _Frame, key: Any) -> list[_Frame]:
        """The mappings that the value of a merge key names: one, or a list of them, of which the first wins."""
        several = done.value if type(done.value) is list else [done.value]
        if not all(type(value) is dict for value in several):
            raise self._error("a merge key needs a mapping, or a list of mappings", key.start_mark)
        if type(done.value) is dict:
            return [done]
        return [_Frame(value, done.place.inside[index]) for index, value in enumerate(several)]

    def _check(self, event: Any) -> None:
        if event.tag is not None:
            raise self._error(f"tags such as {event.tag!r} are not supported", event.start_mark)

    def _check_depth(self, depth: int, event: Any) -> None:
        if depth > DEPTH_LIMIT:
            raise self._error(f"is nested deeper than {DEPTH_LIMIT} levels", event.start_mark)

    def _refuse_as_key(self, event: Any) -> None:
        if self.stack and self.stack[-1].key is None and type(self.stack[-1].value) is dict:
            raise self._error("a key must be plain text", event.start_mark)

    def _error(self, message: str, mark: Any, hint: str | None = None) -> InputError:
        where = {} if mark is None else {"line": mark.line + 1, "column": mark.column + 1}
        return InputError(message, file=self.file, hint=hint, **where)
