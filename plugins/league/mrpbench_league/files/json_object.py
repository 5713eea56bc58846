"""A JSON object from outside: each wrong value is an error with file and line."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text

REQUIRED: Any = object()


@attrs.frozen
class JsonObject:
    """An object of a JSON file and the text that it comes from."""

    file: Path
    text: str
    values: Mapping[str, Any]

    @classmethod
    def read(cls, file: Path) -> "JsonObject":
        """Read a file that holds one object.

        Raises:
            InputError: it is not JSON, or not an object.
        """
        text = read_text(file)
        try:
            values = json.loads(text, parse_constant=_refuse)
        except json.JSONDecodeError as error:
            message = f"is not JSON: {error.msg}"
            raise InputError(message, file=file, line=error.lineno, column=error.colno) from None
        except RecursionError:
            raise InputError("is not JSON: nested too deeply", file=file) from None
        except ValueError as error:
            reason = str(error).partition(";")[0]  # Python's advice on long numbers follows
            raise InputError(f"is not JSON: {reason}", file=file) from None
        if not isinstance(values, dict):
            raise InputError("should hold one JSON object", file=file, line=1)
        return cls(file, text, values)

    def whole(self, key: str, least: int, most: int = 2**31 - 1, default: Any = REQUIRED) -> int:
        """Return a whole number within bounds."""
        value = self._get(key, default)
        if type(value) is not int or not least <= value <= most:
            raise self.error(key, f"should be a whole number from {least} to {most}, is {value!r:.80}")
        return value

    def number(self, key: str, least: float, most: float = math.inf, default: Any = REQUIRED) -> float:
        """Return a finite number within bounds."""
        value = self._get(key, default)
        sound = type(value) in (int, float) and abs(value) < 2**53
        if not sound or not least <= value <= most:
            raise self.error(key, f"should be a number from {least:g} to {most:g}, is {value!r:.80}")
        return float(value)

    def word(self, key: str, choices: tuple[str, ...] = (), default: Any = REQUIRED) -> str:
        """Return a text, one of `choices` if there are any."""
        value = self._get(key, default)
        if not isinstance(value, str) or (choices and value not in choices):
            wanted = f"one of {', '.join(choices)}" if choices else "a text"
            raise self.error(key, f"should be {wanted}, is {value!r:.80}")
        return value

    def items(self, key: str, length: int | None = None) -> list[Any]:
        """Return a list, of `length` if that is given."""
        value = self._get(key, REQUIRED)
        if not isinstance(value, list):
            raise self.error(key, "should be a list")
        if length is not None and len(value) != length:
            raise self.error(key, f"should have {length} items, has {len(value)}")
        return value

    def part(self, key: str) -> "JsonObject":
        """Return an object inside of this one."""
        value = self._get(key, REQUIRED)
        if not isinstance(value, dict):
            raise self.error(key, "should be an object")
        return JsonObject(self.file, self.text, value)

    def error(self, key: str, message: str) -> InputError:
        """Return an error about a key, at the line of its first appearance."""
        place = self.text.find(json.dumps(key))
        line = 1 if place < 0 else self.text.count("\n", 0, place) + 1
        return InputError(f"{key}: {message}", file=self.file, line=line)

    def _get(self, key: str, default: Any) -> Any:
        value = self.values.get(key, default)
        if value is REQUIRED:
            raise InputError(f"has no {key!r}", file=self.file, line=1)
        return value


def _refuse(name: str) -> Any:
    raise ValueError(f"{name} is not a number of JSON")
