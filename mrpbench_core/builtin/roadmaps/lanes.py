"""The roadmap `lanes`: a raster of roads two cells wide along the lanes of the navigation graph."""

from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.builtin.roadmaps.cells import (
    cell_roadmap,
    connect,
    empty_raster,
    one_level,
    only_reachable,
    places,
    without_contacts,
)
from mrpbench_core.builtin.roadmaps.motion import TimedRoadmap
from mrpbench_core.builtin.roadmaps.mrp_bench import mrp_bench_raster
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import called
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.occupancy import CELL_SIZES, Occupancy
from mrpbench_core.model.worlds.world import World

_ROUNDING = 1e-6
"""metres."""


@attrs.frozen(kw_only=True)
class Lanes(TimedRoadmap):
    """Roads along the lanes, wide enough for two robots to pass.

    A cell belongs to a road if its centre is less than one cell from a lane; at exactly one cell it belongs to the road
    on the left of the lane only, so that every straight road is two cells wide. Cells and edges on which the largest
    robot would touch something solid are left out; `Roadmap.notes` lists what that cuts off. The directions of one-way
    lanes are ignored because a road has room for both.

    `compatible: mrp_bench` is the raster of Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic,
    Complex and Cluttered Environments", ICRA 2023, with every quirk of its code; it ignores walls.
    """

    cell_size: float = option(0.4, help="Side of a cell.", unit="m", validator=between(*CELL_SIZES))
    compatible: Literal["mrp_bench"] | None = option(
        None,
        help="`mrp_bench`: exactly the raster of the original benchmark.",
        validator=attrs.validators.optional(attrs.validators.in_(["mrp_bench"])),
    )

    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Rasterise the lanes of a world of one level."""
        if not one_level(world).lanes:
            raise InputError(f"world {world.name!r} has no lanes", hint="try roadmap: grid")
        radius = float(fleet.radii.max())
        if self.compatible is not None:
            cells = connect(mrp_bench_raster(world, self.cell_size))
            place = _own_cells(cells.cell, cells.raster, world)
            left = without_contacts(cells, world, radius)
            return cell_roadmap(self, cells, place, world, fleet, _contacts(len(cells.edges) - len(left.edges), "kept"))
        wide = connect(_roads(world, self.cell_size))
        clear = without_contacts(wide, world, radius)
        place = places(clear, world)
        notes = [
            *_contacts(len(wide.edges) - len(clear.edges), "left out"),
            *_broken(world, place, components(len(clear.cell), clear.edges), radius),
        ]
        cells, place = only_reachable(clear, place)
        return cell_roadmap(self, cells, place, world, fleet, notes)


def _roads(world: World, size: float) -> Occupancy:
    """Return the cells near lanes. The lowest and leftmost vertices lie in the middle of their cells."""
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices])
    margin = 2.5 * size
    raster = empty_raster(point.min(axis=0) - margin, point.max(axis=0) + margin, size)
    blocked = raster.blocked.copy()
    for lane in world.lanes:
        _open_road(blocked, raster, point[lane.start], point[lane.end])
    return attrs.evolve(raster, blocked=blocked)


def _open_road(blocked: Bool, raster: Occupancy, a: Float, b: Float) -> None:
    size = raster.resolution
    start, end = (a, b) if tuple(a) <= tuple(b) else (b, a)  # one side for both directions
    length = float(np.hypot(*(end - start)))
    ahead = (end - start) / length if length > 0 else np.array([1.0, 0.0])
    first = raster.cells(np.minimum(a, b) - 2 * size)[0]
    last = raster.cells(np.maximum(a, b) + 2 * size)[0]
    rows, columns = np.arange(first[0], last[0] + 1), np.arange(first[1], last[1] + 1)
    x = (columns[None, :] + 0.5) * size + raster.origin[0] - start[0]
    y = (rows[:, None] + 0.5) * size + raster.origin[1] - start[1]
    along, left = x * ahead[0] + y * ahead[1], y * ahead[0] - x * ahead[1]
    reach = size / np.sqrt(2) + _ROUNDING  # the cell of each end always belongs to the road
    near = (left > -size + _ROUNDING) & (left <= size + _ROUNDING) & (along >= -reach) & (along <= length + reach)
    blocked[first[0] : last[0] + 1, first[1] : last[1] + 1] &= ~near


def _own_cells(cell: Int, raster: Occupancy, world: World) -> Int:
    """Return the cell of each place as the original does: the cell that contains it, regardless of walls."""
    number = np.full(raster.shape, -1)
    number[cell[:, 0], cell[:, 1]] = np.arange(len(cell))
    row, column = raster.cells(np.array([(vertex.x, vertex.y) for vertex in world.vertices])).T
    place: Int = number[row, column]
    return place


def _contacts(edges: int, fate: str) -> list[str]:
    return [f"{edges} of the raster's edges on which a robot would touch something are {fate}."] if edges else []


def _broken(world: World, place: Int, label: Int, radius: float) -> list[str]:
    """Return a sentence for each lane whose ends are no longer connected."""
    notes = []
    for lane in world.lanes:
        start, end = place[lane.start], place[lane.end]
        if start < 0 or end < 0 or label[start] != label[end]:
            ends = np.array([(world.vertices[index].x, world.vertices[index].y) for index in (lane.start, lane.end)])
            clear = has_clearance(world.levels[0], ends[:1], ends[1:], radius)[0]
            reason = (
                "the passage is too narrow for cells of the raster"
                if clear
                else f"something solid is nearer than {radius:.3f} m"
            )
            notes.append(f"Lane {called(world, lane.start)} – {called(world, lane.end)} is cut: {reason}.")
    return notes
