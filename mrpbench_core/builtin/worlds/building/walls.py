"""Walls and doors of a building file. Walls are as drawn: the editor leaves gaps at doors."""

from mrpbench_core.builtin.worlds.building.node import Node
from mrpbench_core.builtin.worlds.building.notes import Notes
from mrpbench_core.builtin.worlds.building.parameters import Kind, read_parameters
from mrpbench_core.model.arrays import Float, frozen_array
from mrpbench_core.model.world import Door

WALL: dict[str, Kind] = {
    "alpha": float,
    "texture_name": str,
    "texture_height": float,
    "texture_width": float,
    "texture_scale": float,
}
DOOR: dict[str, Kind] = {
    "name": str,
    "type": str,
    "motion_axis": str,
    "motion_direction": int,
    "motion_degrees": float,
    "right_left_ratio": float,
    "plugin": str,
}
MOTIONS = ("hinged", "double_hinged", "sliding", "double_sliding")


def read_walls(level: Node, positions: Float, notes: Notes) -> Float:
    """Centre lines f8[W,4] of the walls in metres."""
    walls = []
    for wall in level.section("walls"):
        start, end, *rest = wall.items(least=2)
        if rest:
            read_parameters(rest[0], WALL, "wall", notes)
        a, b = (positions[node.index(len(positions), "wall")] for node in (start, end))
        walls.append((*a, *b))
    return frozen_array(walls, "f8", 4)


def read_doors(level: Node, positions: Float, notes: Notes) -> tuple[Door, ...]:
    """The doors, in the order of the file."""
    doors = []
    for door in level.section("doors"):
        start, end, *rest = door.items(least=2)
        parameters = read_parameters(rest[0], DOOR, "door", notes) if rest else {}
        (x1, y1), (x2, y2) = (positions[node.index(len(positions), "door")].tolist() for node in (start, end))
        motion = parameters.get("type", "sliding")
        if motion not in MOTIONS:
            notes.add(f"door type {motion!r} is not known and taken for sliding")
            motion = "sliding"
        doors.append(Door(name=parameters.get("name", ""), start=(x1, y1), end=(x2, y2), motion=motion))
    return tuple(doors)
