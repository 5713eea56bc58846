"""Maps of cells with a margin, in batches: places of robots are single numbers, and windows are copied row by row."""

from collections import OrderedDict
from functools import cached_property

import numpy as np
from mrpbench_native import grid
from numpy.typing import NDArray

from mrpbench_core.api import Bool, Int

ACTIONS = ("stay", "up", "down", "left", "right")
"""What a robot may do in a step, by number, as in POGEMA (Skrynnik et al., ICLR 2025). Row 0 is on top."""
MOVES: Int = np.array([(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)], np.int64)
"""i8[5,2]: row and column that each action adds."""
CACHED_BYTES = 256 << 20
"""Of tables of distances, after which those used least recently are dropped."""
FAR = 1 << 20
"""Distance of cells from which a goal cannot be reached."""


class Maps:
    """The maps of b environments, all of one shape.

    A *place* is the number of a cell in the padded maps of all environments, row by row, one map after the other.

    Args:
        blocked: bool[b,rows,columns]; row 0 is on top.
        margin: cells around each map, at least 1, of which the innermost ring is blocked.
    """

    def __init__(self, blocked: Bool, margin: int) -> None:
        self.count, rows, columns = blocked.shape
        self.shape, self.margin = (rows, columns), margin
        self.height, self.width = rows + 2 * margin, columns + 2 * margin
        self.size = self.height * self.width
        padded = np.zeros((self.count, self.height, self.width), bool)
        inner = slice(margin - 1, -margin + 1 or None)
        padded[:, inner, inner] = True
        padded[:, margin : margin + rows, margin : margin + columns] = blocked
        self.blocked: Bool = padded.reshape(-1)
        """bool[b*size]: walls, and the ring around each map. Beyond it the margin is free, as in POGEMA."""
        self.offset: Int = MOVES[:, 0] * self.width + MOVES[:, 1]
        """i8[5]: what each action adds to a place."""
        self.native = grid.Maps(self.blocked, self.height, self.width)
        """What computes on these maps in C++."""
        self._label: NDArray[np.int32] = np.full(len(self.blocked), -1, np.int32)
        self._components: list[Int] = []
        self._distances: OrderedDict[int, NDArray[np.int32]] = OrderedDict()

    @cached_property
    def obstacles(self) -> NDArray[np.float32]:
        """f4[b*size]: 1 at walls and at the ring around each map."""
        return self.blocked.astype(np.float32)

    @cached_property
    def outside(self) -> Bool:
        """bool[b*size]: not a cell of a map."""
        outside = np.ones((self.count, self.height, self.width), bool)
        outside[:, self.margin : self.margin + self.shape[0], self.margin : self.margin + self.shape[1]] = False
        return outside.reshape(-1)

    def places(self, cells: Int) -> Int:
        """Return the places i8[b,n] of cells i8[b,n,2] (row, column)."""
        return self.places_in(np.arange(self.count)[:, None], cells)

    def places_in(self, environment: int | Int, cells: Int) -> Int:
        """Return the places i8[...] of cells i8[...,2] (row, column) in an environment."""
        places: Int = environment * self.size + (cells[..., 0] + self.margin) * self.width + cells[..., 1] + self.margin
        return places

    def lay(self, environment: int, blocked: Bool) -> None:
        """Replace the map of an environment by blocked cells bool[rows,columns]."""
        rows, columns = self.shape
        padded = self.blocked.reshape(self.count, self.height, self.width)[environment]
        padded[self.margin : self.margin + rows, self.margin : self.margin + columns] = blocked
        first, last = environment * self.size, (environment + 1) * self.size
        self.obstacles[first:last] = self.blocked[first:last]
        self._label[first:last] = -1
        for goal in [goal for goal in self._distances if first <= goal < last]:
            del self._distances[goal]

    def cells(self, places: Int) -> Int:
        """Return the cells i8[...,2] (row, column) of places i8[...]."""
        row, column = np.divmod(places % self.size, self.width)
        return np.stack([row, column], axis=-1) - self.margin

    def window_rows(self, places: Int, radius: int) -> Int:
        """Return where the rows of windows around places i8[k] begin, i8[k,2r+1]; radius r is at most the margin."""
        first = places - radius * (self.width + 1)
        rows: Int = first[:, None] + np.arange(2 * radius + 1) * self.width
        return rows

    def windows(self, field: NDArray[np.float32], places: Int, radius: int) -> NDArray[np.float32]:
        """Return f4[k,2r+1,2r+1] of a field f4[b*size] around places i8[k]."""
        side = 2 * radius + 1
        return strips(field, side)[self.window_rows(places, radius)].view(np.float32).reshape(-1, side, side)

    def distances(self, goal: int) -> NDArray[np.int32]:
        """Return the steps i4[size] from each cell of a map to a place on it, `FAR` where there is no way."""
        known = self._distances.get(goal)
        if known is None:
            known = self._distances[goal] = self._flood(goal)
            if len(self._distances) * 4 * self.size > CACHED_BYTES:
                self._distances.popitem(last=False)
        else:
            self._distances.move_to_end(goal)
        return known

    def component(self, place: int) -> Int:
        """Return the places i8[k] that can be reached from a place, itself included."""
        number = int(self._label[place])
        if number < 0:
            base = place - place % self.size
            cells = base + np.flatnonzero(self._flood(place) < FAR)
            number = len(self._components)
            self._label[cells] = number
            self._components.append(cells)
        return self._components[number]

    def _flood(self, goal: int) -> NDArray[np.int32]:
        steps = np.empty(self.size, np.int32)
        self.native.distances(goal, steps)
        return steps


def strips(field: NDArray[np.float32], length: int) -> NDArray[np.void]:
    """Return a view of f4[k] whose elements are `length` values each, so that indexing copies them at once."""
    return np.ndarray(len(field) - length + 1, np.dtype((np.void, 4 * length)), buffer=field.data, strides=(4,))
