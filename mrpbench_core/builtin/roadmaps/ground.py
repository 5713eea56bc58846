"""The ground level of a world of several levels: a raster has only one."""

import attrs
import numpy as np

from mrpbench_core.model.arrays import Int
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.world import World


def ground_level(world: World) -> tuple[World, Int]:
    """The world with only the places and lanes of level 0, and the index of each of its places in `world`."""
    if len(world.levels) == 1:
        return world, np.arange(len(world.vertices))
    kept = [index for index, vertex in enumerate(world.vertices) if vertex.level == 0]
    number = {index: count for count, index in enumerate(kept)}
    lanes = [lane for lane in world.lanes if lane.start in number and lane.end in number]
    ground = attrs.evolve(
        world,
        levels=world.levels[:1],
        vertices=tuple(world.vertices[index] for index in kept),
        lanes=tuple(attrs.evolve(lane, start=number[lane.start], end=number[lane.end]) for lane in lanes),
    )
    return ground, np.array(kept, np.int64)


def whole_world(roadmap: Roadmap, world: World, kept: Int) -> Roadmap:
    """The roadmap of the ground level with the places of the whole `world`; those elsewhere are not on it."""
    if len(world.levels) == 1:
        return roadmap
    place = np.full(len(world.vertices), -1, np.int32)
    place[kept] = roadmap.place
    left = len(world.vertices) - len(kept)
    note = f"A raster has one level, here {world.levels[0].name}: {left} places on other levels are left out."
    return attrs.evolve(roadmap, place=place, notes=(*roadmap.notes, *([note] if left else [])))
