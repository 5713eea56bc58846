"""Rasters of the MovingAI benchmark (`.map`).

Sturtevant, "Benchmarks for Grid-Based Pathfinding", IEEE Transactions on Computational Intelligence and
AI in Games, 2012. Maps of warehouses add the letter `E`.
"""

from pathlib import Path

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.model.common.arrays import Bool

PASSABLE = ".GSE"
"""Ground, swamp or service point, and emitter of goods."""
BLOCKED = "@OTW"
"""Out of bounds, trees and water."""


def read_movingai_map(file: Path) -> Bool:
    """Return the blocked cells, bool[height,width], row 0 on top.

    Raises:
        InputError: the file is not a MovingAI map; with line and column.
    """
    lines = read_text(file).splitlines()
    height, width = _header(file, lines)
    rows = lines[4 : 4 + height]
    for number, row in enumerate(rows, 5):
        if len(row) != width:
            raise InputError(f"this row has {len(row)} letters, not {width}", file=file, line=number)
        strange = [column for column, letter in enumerate(row, 1) if letter not in PASSABLE + BLOCKED]
        if strange:
            hint = f"known: {PASSABLE}{BLOCKED}"
            unknown = f"unknown terrain {row[strange[0] - 1]!r}"
            raise InputError(unknown, file=file, line=number, column=strange[0], hint=hint)
    if len(rows) < height:
        raise InputError(f"the map ends after {len(rows)} of {height} rows", file=file, line=len(lines))
    for number, line in enumerate(lines[4 + height :], 5 + height):
        if line.strip():
            raise InputError(f"more than {height} rows", file=file, line=number)
    letters = np.frombuffer("".join(rows).encode("ascii"), np.uint8).reshape(height, width)
    return np.isin(letters, np.frombuffer(BLOCKED.encode("ascii"), np.uint8))


def _header(file: Path, lines: list[str]) -> tuple[int, int]:
    """Height and width, from `type octile`, `height H`, `width W`, `map`."""
    sizes = []
    for number, key in enumerate(("type", "height", "width", "map"), 1):
        words = lines[number - 1].split() if number <= len(lines) else []
        if not words or words[0] != key:
            expected = f"should be '{key}{' …' if key != 'map' else ''}'"
            raise InputError(expected, file=file, line=number, hint="a MovingAI map")
        if key in ("height", "width"):
            if len(words) != 2 or not (words[1].isdecimal() and words[1].isascii()) or not 0 < int(words[1]) < 10**5:
                raise InputError(f"{key} should be a positive number", file=file, line=number)
            sizes.append(int(words[1]))
    return sizes[0], sizes[1]
