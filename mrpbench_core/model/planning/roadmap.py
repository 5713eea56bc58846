"""The discrete graph that planners search."""

from functools import cached_property

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int16, Int32, array

BEND = 0.3
"""radians: robots turn by less without stopping, see the navigator `waypoints`; with `kinodynamic` durations that takes
one tick."""


@attrs.frozen(kw_only=True)
class Resource:
    """A door, lift or mutex that at most `capacity` robots use at a time (rule 6 of `model.planning.conflicts`).

    A robot uses it while it is at one of its vertices or on one of its edges. A dispatcher requests it before the robot
    enters the first of them; see `Orders.requests`.
    """

    name: str
    """Unique on a roadmap. A door or lift has its name in `mrpbench_core.model.worlds.facilities.Facilities`."""
    kind: str
    """door | lift | mutex."""
    capacity: int = 1
    vertices: tuple[int, ...] = ()
    edges: tuple[int, ...] = ()
    setup_ticks: int = 0
    """Ticks for which it stays in use after a robot has left it, until it is ready for the next one."""
    passage: tuple[int, ...] = ()
    """The edges that lead through a doorway. On its other edges, which the leaves sweep, the door must be closed."""


@attrs.frozen(kw_only=True)
class Raster:
    """The raster whose cells are the vertices of a roadmap."""

    shape: tuple[int, int]
    """rows, columns."""
    cell_size: float
    origin: tuple[float, float]
    """x, y of the lower left corner of cell (0, 0), metres."""
    cell: Int32 = array("i4", 2)
    """i4[V,2]: row (0 = lowest y) and column of each vertex."""


@attrs.frozen(kw_only=True)
class Roadmap:
    """Vertices and directed edges with integer durations. Built once per world and fleet."""

    position: Float = array("f8", 2)
    """f8[V,2] metres, frame `map`."""
    level: Int16 = array("i2")
    """i2[V]: index into `World.levels`."""
    heading: Float = array("f8")
    """f8[V] radians: the yaw a vertex prescribes, NaN = any."""
    edges: Int32 = array("i4", 2)
    """i4[E,2]: from, to. A two-way lane is two edges."""
    duration: Int32 = array("i4")
    """i4[P,E] ticks per motion profile; -1 = this profile may not use the edge."""
    tick: float
    """seconds per tick."""
    resources: tuple[Resource, ...] = ()
    grid: Raster | None = None
    place: Int32 = array("i4", factory=list)
    """i4[len(World.vertices)]: the roadmap vertex that stands for each world vertex, -1 = none."""
    notes: tuple[str, ...] = ()
    """Omissions of the builder, such as edges that hit a wall and blocked places, and their reasons, as sentences."""

    def nearest(self, x: float, y: float, level: int = 0) -> tuple[int, float]:
        """Return the vertex nearest to a point on a level and its distance in metres; -1 and inf if there is none."""
        squared = ((self.position - (x, y)) ** 2).sum(axis=1)
        squared = np.where(self.level == level, squared, np.inf)
        best = int(squared.argmin()) if len(squared) else -1
        if best < 0 or not np.isfinite(squared[best]):
            return -1, float("inf")
        return best, float(np.sqrt(squared[best]))

    def locate(self, points: Float, levels: Int16) -> Int32:
        """Return the vertex i4[n] that represents each of `points` f8[n,2] on `levels` i2[n]; -1 means none.

        On a raster it is the vertex of the cell that contains the point, otherwise the nearest vertex within 1 m; the
        first of several at one place.
        """
        if self.grid is None:
            nearest = [self.nearest(x, y, level) for (x, y), level in zip(points, levels, strict=True)]
            return np.array([vertex if distance <= 1.0 else -1 for vertex, distance in nearest], "i4")
        table, columns = self._first_of_cell, self.grid.shape[1]
        cell = np.floor((np.atleast_2d(points) - self.grid.origin) / self.grid.cell_size).astype(int)
        inside = (cell >= 0).all(1) & (cell[:, 0] < columns) & (cell[:, 1] < self.grid.shape[0])
        inside &= np.asarray(levels) == (self.level[0] if len(self.level) else 0)  # a raster has one level
        return np.where(inside, table[np.where(inside, cell[:, 1] * columns + cell[:, 0], 0)], -1).astype("i4")

    @cached_property
    def _first_of_cell(self) -> Int32:
        """The first vertex i4[rows * columns] in each cell of the raster, -1 = none."""
        assert self.grid is not None
        table = np.full(self.grid.shape[0] * self.grid.shape[1], -1, np.int32)
        flat = self.grid.cell[::-1, 0] * self.grid.shape[1] + self.grid.cell[::-1, 1]
        table[flat] = np.arange(len(flat))[::-1]
        return table

    def facing(self, vertices: Int32, yaw: Float) -> Int32:
        """Return the vertices i4[n] at the places of `vertices` i4[n] whose headings are nearest to `yaw` f8[n].

        A vertex remains as it is where the yaw is NaN, where no vertex at its place has a heading, and where it is -1.
        """
        facing = np.array(vertices, np.int32)
        headed = np.flatnonzero(~np.isnan(self.heading))
        position, level, heading = self.position[headed], self.level[headed], self.heading[headed]
        for index in np.flatnonzero((facing >= 0) & ~np.isnan(yaw)).tolist() if len(headed) else ():
            here = (position == self.position[facing[index]]).all(axis=1) & (level == self.level[facing[index]])
            if here.any():
                error = np.abs(np.remainder(heading[here] - yaw[index] + np.pi, 2 * np.pi) - np.pi)
                facing[index] = headed[here][error.argmin()]
        return facing

    @property
    def distinct(self) -> Int:
        """The first vertex i8[k] of each place, in order; all vertices where no two are at one place."""
        if self.grid is None:
            place = np.column_stack([self.position, self.level])
            return np.sort(np.unique(place, axis=0, return_index=True)[1])
        row, column = self.grid.cell.T
        return np.sort(np.unique(row * self.grid.shape[1] + column, return_index=True)[1])
