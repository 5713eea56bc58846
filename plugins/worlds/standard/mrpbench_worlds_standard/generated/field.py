"""Fields of cylinders in the manner of the BARN challenge, drawn by a seed."""

import heapq
import math

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.worlds.world import World
from mrpbench_worlds_standard.barn import RADIUS, field_world, path_length
from mrpbench_worlds_standard.generated.raster import chances

_CELL, _WEST, _SOUTH = 0.15, -4.425, 0.075
_SIDE, _ROWS, _POCKET = 30, 64, 34
"""Cells of the field from west to east, those from the south end to the north, and those south of the field."""
_BIRTH, _DEATH = 5, 1
"""A cell becomes filled with at least so many filled neighbours of eight, and empty with at most so many."""
_TRIES = 200


@attrs.frozen(kw_only=True)
class GeneratedField(WorldSource):
    """A field of 30 × 30 cells of 0.15 m, which a cellular automaton fills with cylinders, north of an empty pocket.

    After D. Perille, A. Truong, X. Xiao and P. Stone, "Benchmarking Metric Ground Navigation", SSRR 2020, with the
    places, task and score of the world `barn`; the rule of the automaton is our own. A field is drawn until cells that
    are farther than two cells from all cylinders lead through it; the shortest such way is the reference path.
    """

    fill: float = option(
        0.2,
        help="probability that a cell is filled at first; the challenge's are 0.15 to 0.3",
        validator=between(0, 0.35),
    )
    smoothings: int = option(
        3, help="steps of the automaton; the challenge's are 2 to 4", validator=attrs.validators.in_(range(11))
    )
    seed: int = option(0, help="seed of the field")

    def load(self) -> World:
        """Draw the field.

        Raises:
            InputError: no way leads through any of the fields that were drawn.
        """
        draws = chances(self.seed, _TRIES * _SIDE * _SIDE).reshape(_TRIES, _SIDE, _SIDE)
        for draw in draws:
            filled = smoothed(draw < self.fill, self.smoothings)
            filled[:, [0, -1]] = True
            path = shortest_way(~dilated(filled))
            if path is not None:
                return self._world(filled, path)
        raise InputError(f"world: no field of {_TRIES} can be crossed", hint="lower `fill`")

    def _world(self, filled: Bool, path: Float) -> World:
        cells = np.zeros((_ROWS, _SIDE), bool)
        cells[0] = cells[:, 0] = cells[:, -1] = True
        cells[_POCKET:] = filled
        buried = _neighbours(cells) == 8
        row, column = np.nonzero(cells & ~buried)
        places = np.column_stack([_WEST + _CELL * column, _SOUTH + _CELL * row, np.full(len(row), RADIUS)])
        return field_world(f"field_{self.seed}", places, path_length(path))


def _neighbours(filled: Bool) -> Float:
    """Number of filled neighbours of eight of each cell; outside of the raster all are empty."""
    padded = np.pad(filled, 1).astype(float)
    rows, columns = filled.shape
    shifts = [(dy, dx) for dy in range(3) for dx in range(3) if (dy, dx) != (1, 1)]
    total: Float = sum((padded[dy : dy + rows, dx : dx + columns] for dy, dx in shifts), np.zeros(filled.shape))
    return total


def smoothed(filled: Bool, steps: int) -> Bool:
    """Return the cells after some steps of the automaton."""
    for _ in range(steps):
        count = _neighbours(filled)
        filled = (filled | (count >= _BIRTH)) & (count > _DEATH)
    return filled


def dilated(filled: Bool) -> Bool:
    """Return the cells that are at most two rows and columns from a filled one."""
    padded = np.pad(filled, 2)
    rows, columns = filled.shape
    near: Bool = np.zeros(filled.shape, bool)
    for dy in range(5):
        for dx in range(5):
            near |= padded[dy : dy + rows, dx : dx + columns]
    return near


def shortest_way(free: Bool) -> Float | None:
    """Return the cells f8[k,2] of the shortest way from the southern row to the northern one; None = there is none.

    As in the files of the challenge, a cell is named by its column from the west, then its row from the south.
    """
    rows, columns = free.shape
    middle = (-2.25 - _WEST) / _CELL
    cost = {(0, column): abs(column - middle) for column in range(columns) if free[0, column]}
    origin: dict[tuple[int, int], tuple[int, int]] = {}
    queue = [(value, cell) for cell, value in cost.items()]
    heapq.heapify(queue)
    while queue:
        spent, cell = heapq.heappop(queue)
        if spent > cost[cell]:
            continue
        if cell[0] == rows - 1:
            way = [cell]
            while way[-1] in origin:
                way.append(origin[way[-1]])
            return np.array([(column, row) for row, column in reversed(way)], float)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                after = cell[0] + dy, cell[1] + dx
                if not (0 <= after[0] < rows and 0 <= after[1] < columns and free[after]):
                    continue
                total = spent + math.hypot(dy, dx)
                if total < cost.get(after, math.inf):
                    cost[after], origin[after] = total, cell
                    heapq.heappush(queue, (total, after))
    return None
