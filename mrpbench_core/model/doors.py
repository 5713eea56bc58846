"""How doors move: where their leaves are, what these sweep on their way, and how long it takes.

The map says of what kind a door is and how wide; how fast doors move is our estimate, that of an automatic door.
"""

import math

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.world import Door

SLIDE = 0.5
"""m/s of a sliding leaf; of telescope doors, whose leading leaf runs twice as fast, the trailing one's."""
SWING = 0.5
"""rad/s of a hinged leaf."""
_STEPS = 9
"""Corners by which the arc of a hinged leaf is drawn."""


def opening_time(door: Door) -> float:
    """Seconds from shut to open, or back."""
    if "hinged" in door.motion:
        return max(abs(math.radians(door.motion_degrees)) / SWING, 0.1)
    longest = max(_lengths(door))
    return max((longest / 2 if "telescope" in door.motion else longest) / SLIDE, 0.1)


def leaves(door: Door, opening: float) -> Float:
    """Centre lines f8[k,4] x1, y1, x2, y2 of the leaves of a door that is open by a share `opening` 0..1."""
    start, end = np.array(door.start), np.array(door.end)
    along = (end - start) / door.width
    first, second = _lengths(door)
    lines = []
    for post, inward, length, turn in ((start, along, first, 1), (end, -along, second, -1)):
        if not length:
            continue
        if "hinged" in door.motion:
            two = door.motion == "double_hinged"
            angle = math.radians(door.motion_degrees) * door.motion_direction * opening * (turn if two else 1)
            cosine, sine = math.cos(angle), math.sin(angle)
            turned = np.array([cosine * inward[0] - sine * inward[1], sine * inward[0] + cosine * inward[1]])
            lines.append((post, post + length * turned))
        elif "telescope" in door.motion:
            half = length / 2 * inward
            trailing, leading = post - opening * half, post + half - 2 * opening * half
            lines += [(trailing, trailing + half), (leading, leading + half)]
        else:
            slid = post - opening * length * inward
            lines.append((slid, slid + length * inward))
    return np.array(lines).reshape(-1, 4)


def swept(door: Door) -> list[Float]:
    """Polygons f8[k,2] (flat ones for leaves that slide) that together hold the leaves at every opening."""
    shut, open_ = leaves(door, 0.0), leaves(door, 1.0)
    if "hinged" not in door.motion:
        return [np.concatenate([a, b]).reshape(-1, 2) for a, b in zip(shut, open_, strict=True)]
    arcs = np.stack([leaves(door, share)[:, 2:] for share in np.linspace(0, 1, _STEPS)], axis=1)
    # Farther out, so that no straight piece cuts the arc.
    outside = 1 / math.cos(math.radians(door.motion_degrees) / (_STEPS - 1) / 2)
    return [
        np.concatenate([line[None, :2], line[:2] + outside * (arc - line[:2])])
        for line, arc in zip(shut, arcs, strict=True)
    ]


def _lengths(door: Door) -> tuple[float, float]:
    """Metres of the leaf that moves at `start` and of that at `end`, 0 = none."""
    if door.motion.startswith("double"):
        first = door.width / (1 + door.right_left_ratio)
        return first, door.width - first
    return (door.width, 0.0) if door.motion_axis == "start" else (0.0, door.width)
