"""Finds robots that start where doors would hit them."""

from collections.abc import Iterator, Sequence

import numpy as np

from mrpbench_core.checking.clearance import touches
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.doors import leaf_segments, swept_areas
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import World


def check_doorways(
    world: World, roadmap: Roadmap, start: Int, radii: Float, start_names: Sequence[str] = ()
) -> list[str]:
    """The robots that start in a closed door, or where the leaf of a door in use would hit them, one sentence each.

    A leaf stops before it hits a robot, so a robot in its path keeps the door from opening. Doors that no edge passes
    stay closed: starting inside them is the only fault.

    Args:
        world: has the doors.
        roadmap: says which doors are in use.
        start: vertices i4[n], -1 = not on the roadmap (`check_scenario` reports it).
        radii: of the robots f8[n], metres.
        start_names: names of the starts; where missing or empty, coordinates are shown.
    """
    faults = []
    for robot in np.flatnonzero(start >= 0).tolist():
        place = roadmap.position[start[robot] : start[robot] + 1]
        names = start_names[robot : robot + 1]
        where = next((name for name in names if name), "({:.2f}, {:.2f})".format(*place[0]))
        troubles = _troubles(world, roadmap, int(roadmap.level[start[robot]]), place, float(radii[robot]))
        faults += [f"robot {robot} starts at {where}, {trouble}" for trouble in troubles]
    return faults


def _troubles(world: World, roadmap: Roadmap, level: int, place: Float, radius: float) -> Iterator[str]:
    used = {resource.name for resource in roadmap.resources}
    for operated in Facilities(world).doors:
        if level in operated.levels:
            if _touch(_closed_leaves(operated), place, radius):
                yield f"in the closed door {operated.name}"
            elif operated.name in used and _touch(swept_areas(operated.door), place, radius):
                yield f"where the leaf of door {operated.name} opens"


def _closed_leaves(operated: OperatedDoor) -> Sequence[Float]:
    return list(wall_boxes(leaf_segments(operated.door, 0.0), operated.door.thickness).reshape(-1, 4, 4)[:, :, :2])


def _touch(outlines: Sequence[Float], place: Float, radius: float) -> bool:
    return any(bool(touches(outline, place, place, radius)[0]) for outline in outlines)
