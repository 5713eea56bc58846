"""Walls of a building file. They have gaps at doors."""

from mrpbench_core.model.common.arrays import Float, frozen_array
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes
from mrpbench_worlds_standard.building.parameters import Kind, read_parameters

WALL: dict[str, Kind] = {
    "alpha": float,
    "texture_name": str,
    "texture_height": float,
    "texture_width": float,
    "texture_scale": float,
}


def read_walls(level: Node, positions: Float, notes: Notes) -> Float:
    """Return the centre lines f8[W,4] of the walls in metres."""
    walls = []
    for wall in level.section("walls"):
        start, end, *rest = wall.items(least=2)
        if rest:
            read_parameters(rest[0], WALL, "wall", notes)
        a, b = (positions[node.index(len(positions), "wall")] for node in (start, end))
        walls.append((*a, *b))
    return frozen_array(walls, "f8", 4)
