"""The world `generated_rooms`: square rooms joined by doors."""

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.worlds.occupancy import CELL_SIZES
from mrpbench_core.model.worlds.world import World
from mrpbench_worlds_standard.generated.raster import CELL_SIZE, chances, free_raster, raster_world


@attrs.frozen(kw_only=True)
class GeneratedRooms(WorldSource):
    """A rectangle of square rooms with walls one cell thick; a random tree of doors and further doors join them.

    Like the `room-*` maps of Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS 2019.
    """

    across: int = option(4, help="Rooms along x.", validator=attrs.validators.ge(1))
    up: int = option(4, help="Rooms along y.", validator=attrs.validators.ge(1))
    room: int = option(7, help="Cells along a side of a room.", validator=attrs.validators.ge(1))
    door: int = option(1, help="Cells of a door, at most a side of a room.", validator=attrs.validators.ge(1))
    extra_doors: float = option(
        0.3,
        help="Chance of a door in a wall that the tree leaves closed.",
        validator=between(0, 1),
    )
    resolution: float = option(
        CELL_SIZE, help="Side of a cell.", unit="m", validator=between(*CELL_SIZES), former="cell_size"
    )
    seed: int = option(0, help="Seed of the random doors.")

    def __attrs_post_init__(self) -> None:
        if self.door > self.room:
            raise ValueError(f"'door' must be at most 'room', {self.room}: {self.door}")

    def load(self) -> World:
        """Build walls, then open doors."""
        pitch = self.room + 1
        blocked = free_raster(self.up * pitch - 1, self.across * pitch - 1)
        blocked[self.room :: pitch] = True
        blocked[:, self.room :: pitch] = True
        walls = self._walls()
        order, place, more = chances(self.seed, 3 * len(walls)).reshape(3, -1)
        opened = _tree(walls, order, self.across * self.up) | (more < self.extra_doors)
        for (first, second), share in zip(walls[opened].tolist(), place[opened].tolist(), strict=True):
            row, column = (index * pitch for index in divmod(first, self.across))
            offset = int(share * (self.room - self.door + 1))
            if second // self.across == first // self.across:
                blocked[row + offset : row + offset + self.door, column + self.room] = False
            else:
                blocked[row + self.room, column + offset : column + offset + self.door] = False
        rows, columns = blocked.shape
        return raster_world(f"rooms_{columns}x{rows}_{self.seed}", blocked, self.resolution)

    def _walls(self) -> Int:
        """Return the pairs i8[k,2] of neighbouring rooms, numbered row by row: right neighbours, then upper ones."""
        number = np.arange(self.across * self.up).reshape(self.up, self.across)
        pairs = [(number[:, :-1], number[:, 1:]), (number[:-1], number[1:])]
        return np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in pairs])


def _tree(walls: Int, order: Float, rooms: int) -> Bool:
    """Return the walls bool[k] that get a door in the minimum spanning tree of the rooms with weights `order` f8[k].

    Kruskal, "On the shortest spanning subtree of a graph", Proceedings of the AMS, 1956.
    """
    parent = list(range(rooms))
    chosen = np.zeros(len(walls), bool)
    for index in np.argsort(order, kind="stable").tolist():
        first, second = (_root(parent, room) for room in walls[index].tolist())
        if first != second:
            parent[first] = second
            chosen[index] = True
    return chosen


def _root(parent: list[int], room: int) -> int:
    while parent[room] != room:
        parent[room] = parent[parent[room]]
        room = parent[room]
    return room
