"""Worlds of the MovingAI benchmark (`.map`): rasters of terrain letters.

Sturtevant, "Benchmarks for Grid-Based Pathfinding", IEEE Transactions on Computational Intelligence and
AI in Games, 2012.
"""

import attrs
import numpy as np

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World

PASSABLE = ".GS"
"""Ground and swamp."""
BLOCKED = "@OTW"
"""Out of bounds, trees and water."""


@attrs.frozen(kw_only=True)
class MovingAi(WorldSource):
    """A MovingAI `.map`. Passable: `.`, `G` and `S`; blocked: `@`, `O`, `T` and `W`.

    Line r of the map's `height` lines becomes row `height - 1 - r`, so that y points up as everywhere else; x is the
    column. The lower left corner is the origin.
    """

    file: Path = option(help="The .map file.")
    cell_size: float = option(1.0, help="Side of a cell.", unit="m", validator=attrs.validators.gt(0))

    def load(self) -> World:
        """Read the raster; no walls, no places, no lanes."""
        blocked = self._read()
        level = Level(name="L1", occupancy=Occupancy(blocked=blocked[::-1], cell_size=self.cell_size))
        return World(name=self.file.name.removesuffix(".map"), levels=(level,))

    def _read(self) -> Bool:
        lines = read_text(self.file).splitlines()
        height, width = self._header(lines)
        rows = lines[4 : 4 + height]
        for number, row in enumerate(rows, 5):
            if len(row) != width:
                raise self._error(f"this row has {len(row)} letters, not {width}", number)
            strange = [column for column, letter in enumerate(row, 1) if letter not in PASSABLE + BLOCKED]
            if strange:
                letter = row[strange[0] - 1]
                raise self._error(f"unknown terrain {letter!r}", number, strange[0], f"known: {PASSABLE}{BLOCKED}")
        if len(rows) < height:
            raise self._error(f"the map ends after {len(rows)} of {height} rows", len(lines))
        for number, line in enumerate(lines[4 + height :], 5 + height):
            if line.strip():
                raise self._error(f"more than {height} rows", number)
        letters = np.frombuffer("".join(rows).encode("ascii"), np.uint8).reshape(height, width)
        return np.isin(letters, np.frombuffer(BLOCKED.encode("ascii"), np.uint8))

    def _header(self, lines: list[str]) -> tuple[int, int]:
        """Height and width, from `type octile`, `height H`, `width W`, `map`."""
        sizes = []
        for number, key in enumerate(("type", "height", "width", "map"), 1):
            words = lines[number - 1].split() if number <= len(lines) else []
            if not words or words[0] != key:
                raise self._error(f"should be '{key}{' …' if key != 'map' else ''}'", number, hint="a MovingAI map")
            if key in ("height", "width"):
                if (
                    len(words) != 2
                    or not words[1].isdecimal()
                    or not words[1].isascii()
                    or not 0 < int(words[1]) < 10**5
                ):
                    raise self._error(f"{key} should be a positive number", number)
                sizes.append(int(words[1]))
        return sizes[0], sizes[1]

    def _error(self, message: str, line: int, column: int | None = None, hint: str | None = None) -> InputError:
        return InputError(message, file=self.file, line=line, column=column, hint=hint)
