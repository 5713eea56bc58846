"""Packs doors and lifts for the page, which moves them."""

from typing import Any

from mrpbench_core.model.worlds.doors import leaf_segments, swing_angles
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.world import Door, Lift, World
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing

OPENING = 0.005
"""Resolution of the openings of doors (shares) and the heights of cabins (metres)."""


def pack_facilities(recording: Recording, world: World, packing: Packing) -> dict[str, Any]:
    """Return what the page needs to draw doors and cabins; pack their recorded states as `facility`.

    A leaf is `[x1, y1, x2, y2, dx, dy, turn]`: the shut leaf is the line from point 1 to point 2. The open leaf is
    moved by dx, dy metres and turned by `turn` radians around point 1; in between, by a share of that.
    """
    facilities = Facilities(world)
    if "facility" in recording.channels and facilities.names:
        packing.add_metres("facility", recording.channel("facility").T, OPENING)
    lifts = [lift.name for lift in world.lifts]
    return {
        "doors": [_door(door, lifts) for door in facilities.doors],
        "cabins": [_cabin(lift, facilities.heights[lift.name]) for lift in world.lifts],
    }


def _door(door: OperatedDoor, lifts: list[str]) -> dict[str, Any]:
    return {
        "name": door.name,
        "levels": list(door.levels),
        "lift": -1 if door.lift is None else lifts.index(door.lift.name),
        "opens_on": list(door.opens_on),
        "leaves": _leaves(door.door),
    }


def _leaves(door: Door) -> list[list[float]]:
    """Return position and motion of each leaf: hinged leaves turn around their first point, the others slide."""
    leaves = []
    hinged = "hinged" in door.motion
    for index, (shut, open_) in enumerate(zip(leaf_segments(door, 0.0), leaf_segments(door, 1.0), strict=True)):
        way = [0.0, 0.0] if hinged else (open_ - shut)[:2].tolist()
        turn = swing_angles(door)[index] if hinged else 0.0
        leaves.append([round(float(value), 4) for value in (*shut.tolist(), *way, turn)])
    return leaves


def _cabin(lift: Lift, heights: dict[int, float]) -> dict[str, Any]:
    return {
        "name": lift.name,
        "x": round(lift.x, 3),
        "y": round(lift.y, 3),
        "stops": [[level, round(height, 3)] for level, height in heights.items()],
    }
