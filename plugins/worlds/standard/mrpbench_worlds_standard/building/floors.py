"""Floors of a building file, and the holes in them."""

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import Area
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes


def read_areas(level: Node, key: str, positions: Float, notes: Notes) -> tuple[Area, ...]:
    """Return the polygons of the section `key`, `floors` or `holes`; textures are ignored."""
    areas = []
    for node in level.section(key):
        corners = node.section("vertices")
        if len(corners) < 3:
            notes.add(f"{key[:-1]} with fewer than three vertices is left out")
            continue
        areas.append(Area(polygon=positions[[corner.index(len(positions), key[:-1]) for corner in corners]]))
    return tuple(areas)
