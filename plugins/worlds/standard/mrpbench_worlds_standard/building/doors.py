"""Doors of a building file."""

from typing import Any

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import Door
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes
from mrpbench_worlds_standard.building.parameters import Kind, read_parameters

DOOR: dict[str, Kind] = {
    "name": str,
    "type": str,
    "motion_axis": str,
    "motion_direction": int,
    "motion_degrees": float,
    "right_left_ratio": float,
    "plugin": str,
}
MOTIONS = {
    "hinged": ("hinged", "single_swing"),
    "double_hinged": ("double_hinged", "double_swing"),
    "sliding": ("sliding", "single_sliding"),
    "double_sliding": ("double_sliding",),
    "telescope": ("telescope", "single_telescope"),
    "double_telescope": ("double_telescope",),
}
"""The six kinds of doors, and the words of RMF's editor and messages for them."""
_MOTION = {word: motion for motion, words in MOTIONS.items() for word in words}


def read_doors(level: Node, positions: Float, notes: Notes) -> tuple[Door, ...]:
    """Return the doors in the order of the file."""
    doors = []
    for node in level.section("doors"):
        start, end, *rest = node.items(least=2)
        parameters = read_parameters(rest[0], DOOR, "door", notes) if rest else {}
        (x1, y1), (x2, y2) = (positions[item.index(len(positions), "door")].tolist() for item in (start, end))
        if (x1, y1) == (x2, y2):
            notes.add("door of zero length is left out")
            continue
        doors.append(Door(start=(x1, y1), end=(x2, y2), **_motion(parameters, node, notes)))
    return tuple(doors)


def _motion(parameters: dict[str, Any], node: Node, notes: Notes) -> dict[str, Any]:
    kind = parameters.get("type", "sliding")
    if kind not in _MOTION:
        notes.add(f"door type {kind!r} is not known and is treated as sliding")
    axis = parameters.get("motion_axis", "start")
    if axis not in ("start", "end"):  # RMF compares with start only
        notes.add(f"door motion_axis {axis!r} is neither start nor end and is treated as end")
        axis = "end"
    ratio = parameters.get("right_left_ratio", 1.0)
    if ratio <= 0:
        raise node.error(f"door parameter 'right_left_ratio' should be positive, not {ratio:g}")
    return {
        "name": parameters.get("name", ""),
        "motion": _MOTION.get(kind, "sliding"),
        "motion_axis": axis,
        "motion_direction": -1 if parameters.get("motion_direction", 1) < 0 else 1,
        "motion_degrees": parameters.get("motion_degrees", 90.0),
        "right_left_ratio": ratio,
    }
