"""The roadmap `grid`: an occupancy raster of the free space, inflated by the robots' radius."""

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
from mrpbench_core.checking.clearance import solids
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.occupancy import CELL_SIZES, Occupancy
from mrpbench_core.model.worlds.world import World

DEFAULT_CELL_SIZE = 0.4


@attrs.frozen(kw_only=True)
class GridRoadmap(TimedRoadmap):
    """Cells in which the largest robot touches nothing, with edges on which it touches nothing.

    Only cells that are connected with a place of the world are kept, so that robots stay inside the building; in a
    world without places, the largest connected component is kept. The cells of a raster map are taken as they are if
    `cell_size` is that of the map and the robots fit into a cell: every free cell is then kept, as in the MAPF
    benchmarks.
    """

    cell_size: float | None = option(
        None,
        help="Side of a cell; by default that of the map's own raster if robots fit into its cells, else 0.4 m.",
        unit="m",
        validator=attrs.validators.optional(between(*CELL_SIZES)),
    )

    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Rasterise a world of one level."""
        level = one_level(world).levels[0]
        radius = float(fleet.radii.max())
        occupancy = level.occupancy
        if occupancy is not None and (self.cell_size or _default(occupancy, radius)) == occupancy.resolution:
            cells = connect(occupancy)
            if 2 * radius <= occupancy.resolution and not solids(
                level
            ):  # moving between neighbours never leaves the two cells
                return cell_roadmap(self, cells, places(cells, world), world, fleet, [])
        else:
            cells = connect(_open_raster(world, self.cell_size or DEFAULT_CELL_SIZE))
        cells = without_contacts(cells, world, radius)
        cells, place = only_reachable(cells, places(cells, world))
        return cell_roadmap(self, cells, place, world, fleet, [])


def _default(occupancy: Occupancy, radius: float) -> float:
    """Return the default cell size. A map made by lidar has cells smaller than robots, too many to plan on."""
    return occupancy.resolution if 2 * radius <= occupancy.resolution else max(occupancy.resolution, DEFAULT_CELL_SIZE)


def _open_raster(world: World, cell_size: float) -> Occupancy:
    """Return a raster of free cells that covers everything on level 0."""
    level = world.levels[0]
    corners = [*solids(level), np.array([(v.x, v.y) for v in world.vertices]).reshape(-1, 2)]
    if level.occupancy is not None:
        rows, columns = level.occupancy.shape
        corners.append(level.occupancy.centres(np.array([(-0.5, -0.5), (rows - 0.5, columns - 0.5)])))
    points = np.concatenate(corners)
    if not len(points):
        raise InputError(f"world {world.name!r} is empty: no walls, no raster, no places")
    raster = empty_raster(points.min(axis=0), points.max(axis=0), cell_size)
    return attrs.evolve(raster, blocked=np.zeros(raster.shape, bool))
