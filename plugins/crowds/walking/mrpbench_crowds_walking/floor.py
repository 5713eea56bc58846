"""Where people can walk on a level, and the ways to their goals."""

import numpy as np
from mrpbench_native.sim import walking_routes

from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.common.geometry import inside
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World

CELL = 0.15
"""Metres of a cell."""
MARGIN = 0.02
"""Metres that ways keep from walls in addition to the radius."""


class Floor:
    """A raster of the places at which a disc of `radius` metres fits on a level, without the cabins of lifts.

    Raises:
        InputError: it fits nowhere.
    """

    def __init__(self, world: World, level: int, radius: float) -> None:
        storey = world.levels[level]
        ends = segments(world, level).reshape(-1, 2)
        if not len(ends):
            raise InputError(f"crowds: level {level} of world {world.name} has no walls, which bound a crowd")
        self._origin = ends.min(axis=0)
        columns, rows = (np.ceil((ends.max(axis=0) - self._origin) / CELL).astype(int) + 1).tolist()
        x, y = np.meshgrid(np.arange(columns), np.arange(rows))
        self._centre = self._origin + (np.stack([x.ravel(), y.ravel()], axis=1) + 0.5) * CELL
        free = has_clearance(storey, self._centre, self._centre, radius + MARGIN)
        for lift in world.lifts:
            low, high = lift.corners.min(axis=0) - radius, lift.corners.max(axis=0) + radius
            free &= ~((self._centre > low) & (self._centre < high)).all(axis=1)
        if storey.floors:  # the building may be open to the outside
            free &= np.any([inside(area.polygon, self._centre) for area in storey.floors], axis=0)
        self._free = free.reshape(rows, columns)
        self._bounded = bool(storey.floors)
        inner = self._joined()
        self.places: Float = self._centre[inner.ravel()]
        """f8[k,2] centres of the cells of the largest connected part."""
        if not len(self.places):
            raise InputError(f"crowds: nobody of radius {radius:g} m fits on level {level} of world {world.name}")
        self._routes: dict[int, Int32] = {}

    def _joined(self) -> Bool:
        """The largest connected part of the free cells; without a drawn floor, one that does not reach the border."""
        left, best = self._free.copy(), np.zeros_like(self._free)
        while left.any():
            seed = int(left.ravel().argmax())
            part = (walking_routes(self._free.astype(np.uint8), seed) >= 0).reshape(left.shape) & self._free
            border = part[0].any() or part[-1].any() or part[:, 0].any() or part[:, -1].any()
            if (self._bounded or not border) and part.sum() > best.sum():
                best = part
            left &= ~part
        return best

    def cell(self, place: Float) -> Int:
        """Numbers i8[k] of the cells in which places f8[k,2] are."""
        rows, columns = self._free.shape
        x, y = ((place - self._origin) / CELL).astype(int).T
        cell: Int = np.clip(y, 0, rows - 1) * columns + np.clip(x, 0, columns - 1)
        return cell

    def reaches(self, start: Float, goal: Float) -> bool:
        """Tell whether there is a way from a place to another one, f8[2] each."""
        begin, end = self.cell(np.stack([start, goal])).tolist()
        return bool(self._route(end)[begin] >= 0)

    def nearest(self, place: Float, within: float = 1.0) -> Float | None:
        """Return the nearest of `places` to a place f8[2]; None if none is within so many metres."""
        away = np.hypot(*(self.places - place).T)
        closest: Float = self.places[away.argmin()]
        return closest if away.min() <= within else None

    def towards(self, place: Float, goal: Float) -> Float:
        """The points f8[k,2] to which to walk straight on the ways from places to goals, f8[k,2] each."""
        end, begin = self.cell(goal), self.cell(place)
        following = np.empty_like(end)
        for last in set(end.tolist()):
            bound = end == last
            following[bound] = self._route(last)[begin[bound]]
        straight = (following == end) | (following == -1)
        point: Float = np.where(straight[:, None], goal, self._centre[following])
        return point

    def route_past(self, place: Float, goal: Float, bodies: Float, reach: Float) -> Int32 | None:
        """Return the routes to a goal f8[2], for `along`, that keep `reach` f8[k] metres from bodies f8[k,2].

        None if none of them begins at the place f8[2].
        """
        begin, end = self.cell(np.stack([place, goal])).tolist()
        free = self._free.ravel().copy()
        for body, distance in zip(bodies, reach, strict=True):
            free &= np.hypot(*(self._centre - body).T) >= distance
        free[end] = self._free.ravel()[end]
        routes: Int32 = walking_routes(free.reshape(self._free.shape).astype(np.uint8), end)
        return routes if routes[begin] >= 0 else None

    def along(self, routes: Int32, place: Float, goal: Float) -> Float:
        """Return the point f8[2] to which to walk straight from a place f8[2] on `routes` to a goal f8[2]."""
        begin, end = self.cell(np.stack([place, goal])).tolist()
        following = routes[begin]
        point: Float = goal if following in (end, -1) else self._centre[following]
        return point

    def _route(self, end: int) -> Int32:
        if end not in self._routes:
            self._routes[end] = walking_routes(self._free.astype(np.uint8), end)
        return self._routes[end]
