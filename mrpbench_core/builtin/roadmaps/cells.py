"""Roadmaps whose vertices are cells of a raster and whose edges join 4-neighbours; shared by `grid` and `lanes`."""

import attrs
import numpy as np

from mrpbench_core.builtin.roadmaps.facilities import with_facilities
from mrpbench_core.builtin.roadmaps.motion import TimedRoadmap, dividing_tick, driving_ticks
from mrpbench_core.builtin.roadmaps.open_doors import clears_open_doors
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import called
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Raster, Roadmap
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World

LIMIT = 10_000_000
"""Largest number of cells of a raster; a larger one means that the cell size is a mistake."""

_AROUND = np.array([(0, 0), *((row, column) for row in (-1, 0, 1) for column in (-1, 0, 1) if row or column)])


@attrs.frozen
class Cells:
    """Free cells and the undirected edges between neighbours."""

    raster: Occupancy
    cell: Int
    """i8[V,2]: row and column, in row-major order."""
    edges: Int
    """i8[E,2]: each pair of neighbours once, the lower vertex first."""

    @property
    def centre(self) -> Float:
        """f8[V,2] metres."""
        return self.raster.centres(self.cell)

    def only(self, mask: Bool) -> "Cells":
        """Return the cells that are `kept` bool[V] and the edges between them."""
        number = np.cumsum(mask) - 1
        edges = self.edges[mask[self.edges].all(axis=1)]
        return Cells(self.raster, self.cell[mask], number[edges])


def empty_raster(low: Float, high: Float, cell_size: float) -> Occupancy:
    """Return a raster of blocked cells that covers the box from `low` to `high` and begins at `low`.

    Raises:
        InputError: the raster would have too many cells.
    """
    columns, rows = (int(count) for count in np.maximum(1, np.ceil((high - low) / cell_size - 1e-9)))
    if rows * columns > LIMIT:
        raise InputError(f"cell_size {cell_size:g} m makes {rows} × {columns} cells", hint="choose a larger cell_size")
    origin = (float(low[0]), float(low[1]))
    return Occupancy(blocked=np.ones((rows, columns), bool), resolution=cell_size, origin=origin)


def connect(raster: Occupancy) -> Cells:
    """Return all free cells of `raster` and the edges between 4-neighbours, without regard to walls."""
    free = ~raster.blocked
    number = np.where(free, np.cumsum(free).reshape(free.shape) - 1, -1)
    edges = []
    for here, there in ((number[:, :-1], number[:, 1:]), (number[:-1], number[1:])):  # rightwards, upwards
        both = (here >= 0) & (there >= 0)
        edges.append(np.stack([here[both], there[both]], axis=1))
    return Cells(raster, np.argwhere(free), np.concatenate(edges))


def one_level(world: World) -> World:
    """Return the world itself.

    Raises:
        InputError: the world has several levels.
    """
    if len(world.levels) > 1:
        names = ", ".join(level.name for level in world.levels)
        one = f"load one level, world: {{plugin: rmf, file: ..., level: {world.levels[0].name}}}"
        raise InputError(
            f"a raster has one level, and world {world.name!r} has {len(world.levels)}: {names}",
            hint=f"use roadmap: graph, or {one}" if world.lanes else one,
        )
    return world


def without_contacts(cells: Cells, world: World, radius: float) -> Cells:
    """Return the cells and edges on which a disc of `radius` metres touches nothing solid."""

    def clear(start: Float, end: Float) -> Bool:
        solid = has_clearance(world.levels[0], start, end, radius)
        return solid & clears_open_doors(world, 0, start, end, radius)

    cells = cells.only(clear(cells.centre, cells.centre))
    centre = cells.centre
    return Cells(cells.raster, cells.cell, cells.edges[clear(centre[cells.edges[:, 0]], centre[cells.edges[:, 1]])])


def places(cells: Cells, world: World) -> Int:
    """Return the cell i8[len(world.vertices)] that represents each place; -1 means none.

    It is the cell that contains the place or, if that is not free, the nearest of its eight neighbours. A cell behind a
    wall is never taken.
    """
    rows, columns = cells.raster.shape
    number = np.full((rows + 2, columns + 2), -1)  # the margin saves a bounds check of neighbours
    number[cells.cell[:, 0] + 1, cells.cell[:, 1] + 1] = np.arange(len(cells.cell))
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices]).reshape(-1, 2)
    around = cells.raster.cells(point)[:, None] + _AROUND
    known = ((around >= -1) & (around <= (rows, columns))).all(axis=2)
    row, column = np.where(known[..., None], around + 1, 0).transpose(2, 0, 1)
    candidate = np.where(known, number[row, column], -1)
    centre = cells.raster.centres(around.reshape(-1, 2))
    far = np.hypot(*(centre - np.repeat(point, len(_AROUND), axis=0)).T).reshape(candidate.shape)
    far[:, 0] = -1.0  # the own cell first
    place, k = np.where(candidate >= 0)
    behind = ~has_clearance(world.levels[0], point[place], cells.raster.centres(around[place, k]), 0.0)
    candidate[place[behind], k[behind]] = -1
    best = np.where(candidate >= 0, far, np.inf).argmin(axis=1) if len(point) else np.empty(0, np.int64)
    chosen: Int = candidate[np.arange(len(point)), best]
    return chosen


def only_reachable(cells: Cells, place: Int) -> tuple[Cells, Int]:
    """Return the cells that are connected with a place, and the new numbers of the places.

    Without places they are the cells of the largest connected component.
    """
    label = components(len(cells.cell), cells.edges)
    named = place[place >= 0]
    if len(named):
        connected = np.isin(label, label[named])
    else:
        connected = label == np.bincount(label).argmax() if len(label) else np.empty(0, bool)
    number = np.cumsum(connected) - 1
    return cells.only(connected), np.where(place >= 0, number[np.maximum(place, 0)] if len(connected) else -1, -1)


def cell_roadmap(
    timing: TimedRoadmap, cells: Cells, place: Int, world: World, fleet: Fleet, notes: list[str]
) -> Roadmap:
    """Return the roadmap: two directed edges per pair of neighbours, sorted by start.

    If durations are constant, every edge takes one tick, in which the slowest robot crosses a cell.

    Raises:
        InputError: no cell is free, or robots are bound to a navigation graph.
    """
    if not len(cells.cell):
        raise _no_cell(world)
    lost = [called(world, int(index)) for index in np.flatnonzero(place < 0)]
    if lost:
        notes = [*notes, f"No robot can stand at {', '.join(lost)}."]
    edges = np.concatenate([cells.edges, cells.edges[:, ::-1]])
    edges = edges[np.lexsort((edges[:, 1], edges[:, 0]))]
    profiles = timing.profiles(fleet)
    if any(robot.graph is not None for robot in profiles):
        raise InputError(
            "a raster has no lanes, so robots cannot keep to a navigation graph", hint="use roadmap: graph"
        )
    count = len(cells.cell)
    raster = cells.raster
    tick = raster.resolution / min(robot.max_speed for robot in profiles)
    duration = np.ones((len(profiles), len(edges)), np.int64)
    if timing.is_kinodynamic:
        tick = dividing_tick(tick)
        speed = np.array([robot.max_speed for robot in profiles])
        duration *= driving_ticks(np.array(raster.resolution), speed, tick)[:, None]
    roadmap = Roadmap(
        position=cells.centre,
        level=np.zeros(count, np.int16),
        heading=np.full(count, np.nan),
        edges=edges,
        duration=duration.astype(np.int32),
        tick=tick,
        grid=Raster(
            shape=raster.shape, cell_size=raster.resolution, origin=raster.origin, cell=cells.cell.astype(np.int32)
        ),
        place=place.astype(np.int32),
        notes=tuple(notes),
    )
    return timing.timed(with_facilities(roadmap, world, float(fleet.radii.max())), profiles)


def _no_cell(world: World) -> InputError:
    raster = world.levels[0].occupancy
    if raster is not None and raster.blocked.all():
        return InputError(f"world {world.name!r} has no free cell", hint="; ".join(world.notes) or None)
    return InputError(f"world {world.name!r} has no cell that a robot fits in", hint="try a smaller cell_size")
