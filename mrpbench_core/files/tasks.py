"""Tasks in files: YAML or JSON with the key `tasks`, as scenario files have it, or a CSV table.

```csv
release,errands,service,deadline,priority,name
0,returns;dock_2|dock_3,5,,,
12.5,3.0 4.5;1.5 2.0 1;dock_1,2;0;8,120,1,urgent
```
Only the column `errands` is required: places in order, separated by `;`. An errand with several places, split by `|`,
is done at any of them. A place is the name of a vertex of the world, or x y (metres), then level (index, 0 if absent),
then yaw (radians, any if absent), separated by spaces. `service` (seconds) is one number for all errands, or one for
each. `release` and `deadline` are simulated seconds. Empty cells
stand for 0, and no deadline.
"""

import csv
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.files.text import read_text
from mrpbench_core.files.yaml import Document, Steps, load
from mrpbench_core.model.planning.scenario import Task

Place = tuple[tuple[float, float, float], int]
"""x, y (metres), yaw (radians, NaN = any), and level."""
Find = Callable[[str], Place]
"""Returns the place of a name; raises InputError without a location."""

COLUMNS = ("release", "errands", "service", "deadline", "priority", "name")
KEYS = {"name", "release", "goals", "service", "deadline", "priority"}
_LEVELS = np.iinfo(np.int16)


@attrs.frozen
class FiledTask:
    """A task of a file."""

    task: Task
    file: Path
    line: int

    def error(self, message: str, hint: str | None = None) -> InputError:
        """Return an error about this task."""
        return InputError(message, file=self.file, line=self.line, hint=hint)


def read_tasks(path: Path, find: Find) -> list[FiledTask]:
    """Return the tasks of a file in its order.

    Args:
        path: a CSV table if its name ends with `.csv`, else YAML or JSON.
        find: finds places by name.

    Raises:
        InputError: it cannot be read or is malformed; the error names file and line.
    """
    if path.suffix.lower() == ".csv":
        return _read_table(path, find)
    reader = TaskReader(load(path), find)
    reader.mapping((), {"mrpbench_scenario", "robots", "tasks"}, {"tasks"})
    steps: list[Steps] = [("tasks", index) for index in range(reader.length(("tasks",)))]
    return [FiledTask(reader.task(step), path, reader.document.mark(step)[0]) for step in steps]


class TaskReader:
    """Reads the parts of a YAML document that holds tasks; its errors have a location."""

    def __init__(self, document: Document, find: Find | None = None) -> None:
        self.document, self._find = document, find

    def at(self, steps: Steps) -> Any:
        """Return the value at `steps`."""
        value = self.document.data
        for step in steps:
            value = value[step]
        return value

    def task(self, steps: Steps) -> Task:
        """Return a task."""
        mapping = self.mapping(steps, KEYS, {"goals"})
        goals = (*steps, "goals")
        errands = [self._errand((*goals, index)) for index in range(self.length(goals))]
        if not errands:
            raise self.document.error("a task needs a goal", goals)
        priority = mapping.get("priority", 0)
        if type(priority) is not int or abs(priority) >= 2**31:
            raise self.document.error("must be a whole number", (*steps, "priority"))
        return Task(
            **_places(errands),
            name=self.text(mapping, steps),
            release=self._seconds((*steps, "release")) if "release" in mapping else 0.0,
            service=self._service((*steps, "service"), len(errands), mapping),
            deadline=self._seconds((*steps, "deadline")) if "deadline" in mapping else math.inf,
            priority=priority,
        )

    def _errand(self, steps: Steps) -> list[Place]:
        """Places of an errand: one, or a list of which any will do."""
        if not isinstance(self.at(steps), list):
            return [self._goal(steps)]
        if not self.length(steps):
            raise self.document.error("an errand needs a place", steps)
        return [self._goal((*steps, index)) for index in range(self.length(steps))]

    def _goal(self, steps: Steps) -> Place:
        name = self.document.text(steps)
        if self._find is not None and name is not None:
            try:
                return self._find(name)
            except InputError as error:
                raise self.document.error(error.message, steps, hint=error.hint) from None
        self.mapping(steps, {"x", "y", "yaw", "level"}, {"x", "y"})
        return self.place(steps)

    def _service(self, steps: Steps, errands: int, mapping: Mapping[str, Any]) -> np.ndarray:
        if "service" not in mapping:
            return np.zeros(errands)
        if not isinstance(self.at(steps), list):
            return np.full(errands, self._seconds(steps))
        if self.length(steps) != errands:
            raise self.document.error(f"must be one number, or one for each of the {errands} goals", steps)
        return np.array([self._seconds((*steps, index)) for index in range(errands)])

    def _seconds(self, steps: Steps) -> float:
        seconds = self.number(steps)
        if seconds < 0:
            raise self.document.error("must not be negative", steps)
        return seconds

    def place(self, steps: Steps) -> Place:
        """Return a place in metres."""
        mapping = self.at(steps)
        yaw = self.number((*steps, "yaw")) if "yaw" in mapping else math.nan
        level = mapping.get("level", 0)
        if type(level) is not int or not 0 <= level <= _LEVELS.max:
            raise self.document.error("must be the index of a level, from 0", (*steps, "level"))
        return (self.number((*steps, "x")), self.number((*steps, "y")), yaw), level

    def number(self, steps: Steps) -> float:
        """Return a finite number."""
        value = self.at(steps)
        try:
            if type(value) in (int, float) and math.isfinite(value):
                return float(value)
        except OverflowError:
            pass
        raise self.document.error("must be a finite number", steps)

    def text(self, mapping: Mapping[str, Any], steps: Steps) -> str:
        """Return the name in a mapping, or ''."""
        if mapping.get("name") is None:
            return ""
        name = self.document.text((*steps, "name"))
        if name is None:
            raise self.document.error("must be text", (*steps, "name"))
        return name

    def length(self, steps: Steps) -> int:
        """Return the length of a list."""
        value = self.at(steps)
        if not isinstance(value, list):
            raise self.document.error("must be a list", steps)
        return len(value)

    def mapping(self, steps: Steps, known: set[str], required: set[str]) -> Mapping[str, Any]:
        """Return a mapping with known keys, and all that are required."""
        value = self.at(steps)
        if not isinstance(value, dict):
            raise self.document.error(f"must be a mapping with {', '.join(sorted(required))}", steps)
        for key in value:
            if key not in known:
                hint = did_you_mean(key, known, f"keys are {', '.join(sorted(known))}")
                raise self.document.error(f"unknown key {key!r}", (*steps, key), key=True, hint=hint)
        for key in sorted(required - set(value)):
            raise self.document.error(f"lacks {key!r}", steps)
        return value


def _places(errands: Sequence[Sequence[Place]]) -> dict[str, Any]:
    """The fields of a task that say where its errands are."""
    return {
        "goals": np.array([pose for places in errands for pose, _ in places]),
        "errand": np.repeat(np.arange(len(errands)), [len(places) for places in errands]),
        "levels": np.array([level for places in errands for _, level in places], np.int16),
    }


def _read_table(path: Path, find: Find) -> list[FiledTask]:
    """Read a CSV table."""
    rows = csv.reader(read_text(path).splitlines(), strict=True)
    try:
        columns = [word.strip() for word in next(rows, [])]
        for column in columns:
            if column not in COLUMNS:
                hint = did_you_mean(column, COLUMNS, f"columns are {', '.join(COLUMNS)}")
                raise InputError(f"unknown column {column!r}", file=path, line=1, hint=hint)
        if "errands" not in columns or len(set(columns)) < len(columns):
            raise InputError("the first line must name the column 'errands', and each column once", file=path, line=1)
        return [_Row(path, rows.line_num, columns, row).read(find) for row in rows if row]
    except csv.Error as error:
        raise InputError(f"is not CSV: {error}", file=path, line=rows.line_num) from None


class _Row:
    """A row of a table of tasks."""

    def __init__(self, file: Path, line: int, columns: Sequence[str], cells: Sequence[str]) -> None:
        self._file, self._line = file, line
        if len(cells) != len(columns):
            raise self._error(f"has {len(cells)} cells instead of {len(columns)}")
        self._cells = dict(zip(columns, (cell.strip() for cell in cells), strict=True))

    def read(self, find: Find) -> FiledTask:
        errands = [
            [self._place(word.strip(), find) for word in words.split("|")]
            for words in self._cells["errands"].split(";")
        ]
        service = [self._seconds("service", word) for word in self._cells.get("service", "").split(";")]
        if len(service) not in (1, len(errands)):
            raise self._error(f"service: has {len(service)} times instead of 1 or {len(errands)}")
        priority = self._number("priority", self._cells.get("priority", ""), 0.0)
        if priority != int(priority) or abs(priority) >= 2**31:
            raise self._error(f"priority: {self._cells['priority']!r} is not a whole number")
        task = Task(
            **_places(errands),
            name=self._cells.get("name", ""),
            release=self._seconds("release", self._cells.get("release", "")),
            service=np.resize(service, len(errands)),
            deadline=self._seconds("deadline", self._cells.get("deadline", ""), math.inf),
            priority=int(priority),
        )
        return FiledTask(task, self._file, self._line)

    def _place(self, word: str, find: Find) -> Place:
        if not word:
            raise self._error("errands: a place is empty", "errands are separated by ';', places of one errand by '|'")
        try:
            x, y, *others = map(float, word.split())
        except ValueError:
            try:
                return find(word)
            except InputError as error:
                raise self._error(f"errands: {error.message}", error.hint) from None
        level, yaw, *more = [*others, *(0.0, math.nan)[len(others) :]]
        if more or not math.isfinite(x + y) or level not in range(_LEVELS.max) or math.isinf(yaw):
            raise self._error(f"errands: {word!r} is not a place", "x y, x y level or x y level yaw")
        return (x, y, yaw), int(level)

    def _seconds(self, column: str, word: str, default: float = 0.0) -> float:
        seconds = self._number(column, word, default)
        if seconds < 0:
            raise self._error(f"{column}: must not be negative")
        return seconds

    def _number(self, column: str, word: str, default: float) -> float:
        if not word.strip():
            return default
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise self._error(f"{column}: {word.strip()!r} is not a finite number")
        return number

    def _error(self, message: str, hint: str | None = None) -> InputError:
        return InputError(message, file=self._file, line=self._line, hint=hint)
