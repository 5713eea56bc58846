"""The files of POGEMA's benchmark: maps as text, and lists of starts and goals."""

import string
from functools import lru_cache
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import yaml

from mrpbench_core.api import Bool, InputError, Int, read_text

FREE, BLOCKED = ".@$!", "#"
"""Letters of cells; those of the alphabet, a robot and in capitals its goal, are free as well."""


@attrs.frozen(kw_only=True, eq=False)
class Listed:
    """The starts and goals of one map and seed."""

    name: str
    seed: int
    start: Int
    """i8[n,2] row, from the top, and column."""
    goals: tuple[Int, ...]
    """For each robot i8[k,2] cells, which it visits in order; one in one-shot problems."""


def read_map(file: Path, name: str) -> Bool:
    """Return the blocked cells bool[rows,columns] of a map in a file of maps; row 0 is on top.

    Raises:
        InputError: the file does not contain the map, or the map has another letter or rows of different lengths.
    """
    document = _document(file, _stamp(file))
    text = document.get(name) if isinstance(document, dict) else None
    if not isinstance(text, str):
        known = ", ".join(map(str, list(document)[:3])) if isinstance(document, dict) else "no maps"
        raise InputError(f"has no map {name!r}", file=file, hint=f"it has {known}")
    rows = [row.strip() for row in text.strip().splitlines()]
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            message = f"map {name!r}: row {number} has {len(row)} letters, the first one {len(rows[0])}"
            raise InputError(message, file=file)
        strange = [letter for letter in row if letter not in FREE + BLOCKED + string.ascii_letters]
        if strange:
            message = f"map {name!r}: row {number} has the letter {strange[0]!r}"
            raise InputError(message, file=file, hint=f"known: {FREE}{BLOCKED} and those of the alphabet")
    return np.array([[letter == BLOCKED for letter in row] for row in rows])


def read_scenario(file: Path, name: str, seed: int) -> Listed:
    """Return the starts and goals for a map and a seed; where the map has those of one seed only, these.

    Raises:
        InputError: the file has none, or they are malformed.
    """
    document = _document(file, _stamp(file))
    listed = document.get("scenarios") if isinstance(document, dict) else None
    if not isinstance(listed, dict):
        raise InputError("has no block `scenarios`", file=file, hint="a file of experiments of POGEMA's benchmark")
    of_map = {key: it for key, it in listed.items() if isinstance(it, dict) and it.get("map_name") == name}
    if not of_map:
        raise InputError(f"has no scenario for the map {name!r}", file=file)
    of_seed = {key: it for key, it in of_map.items() if it.get("seed") == seed} if len(of_map) > 1 else of_map
    if not of_seed:
        seeds = sorted({str(it.get("seed")) for it in of_map.values()}, key=lambda text: (len(text), text))
        message = f"has no scenario with seed {seed} for the map {name!r}"
        raise InputError(message, file=file, hint=f"seeds {seeds[0]} to {seeds[-1]}")
    key, content = next(iter(of_seed.items()))
    start = _cells(content.get("agents_xy"), file, f"{key}: agents_xy")
    targets = content.get("targets_xy")
    if not isinstance(targets, list) or len(targets) != len(start):
        raise InputError(f"{key}: targets_xy is not a list of {len(start)} goals, as agents_xy", file=file)
    sequences = (it if isinstance(it, list) and it and isinstance(it[0], list) else [it] for it in targets)
    goals = tuple(_cells(sequence, file, f"{key}: targets_xy") for sequence in sequences)
    return Listed(name=str(key), seed=int(content.get("seed") or 0), start=start, goals=goals)


def _cells(value: Any, file: Path, what: str) -> Int:
    cells = value if isinstance(value, list) else []
    sound = all(isinstance(cell, list) and len(cell) == 2 for cell in cells)
    if not (cells and sound and all(type(it) is int and 0 <= it < 2**15 for cell in cells for it in cell)):
        raise InputError(f"{what} is not a list of cells [row, column]", file=file)
    return np.array(value, np.int64)


def _stamp(file: Path) -> tuple[int, int]:
    try:
        stat = file.stat()
    except OSError:
        return 0, 0
    return stat.st_mtime_ns, stat.st_size


@lru_cache(maxsize=4)
def _document(file: Path, _: tuple[int, int]) -> Any:
    """The content of a YAML file; the last ones are kept, since those of the benchmark have a megabyte."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        return yaml.load(read_text(file), loader)  # noqa: S506 - a safe loader
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = None if mark is None else mark.line + 1
        problem = getattr(error, "problem", None) or "malformed"
        raise InputError(f"is not YAML: {problem}", file=file, line=line) from None
    except (ValueError, RecursionError):
        raise InputError("is not YAML of maps or scenarios", file=file) from None
