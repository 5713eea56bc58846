"""The motion of doors: the position of each leaf, the area that it sweeps, and its duration.

The map gives the kind and the width of a door. Maps do not give its speed; ours is that of a common automatic door.
"""

import math

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.world import Door

SLIDING_SPEED = 0.5
"""m/s of a sliding leaf. In a telescope door, the trailing leaf has it and the leading leaf twice of it."""
SWING_SPEED = 0.5
"""rad/s of a hinged leaf."""
_STEPS = 9
"""Corners that approximate the arc of a hinged leaf."""


def opening_time(door: Door) -> float:
    """Return the seconds that a door takes from closed to open, which is also the time back."""
    if "hinged" in door.motion:
        return max(abs(math.radians(door.motion_degrees)) / SWING_SPEED, 0.1)
    longest = max(_lengths(door))
    return max((longest / 2 if "telescope" in door.motion else longest) / SLIDING_SPEED, 0.1)


def leaf_segments(door: Door, opening: float) -> Float:
    """Return the centre lines f8[k,4] (x1, y1, x2, y2 in metres) of the leaves; `opening` is 0 if closed, 1 if open."""
    start, end = np.array(door.start), np.array(door.end)
    along = (end - start) / door.width
    first, second = _lengths(door)
    lines = []
    turns = swing_angles(door)
    for post, inward, length, turn in ((start, along, first, turns[0]), (end, -along, second, turns[1])):
        if not length:
            continue
        if "hinged" in door.motion:
            cosine, sine = math.cos(opening * turn), math.sin(opening * turn)
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


def swing_angles(door: Door) -> tuple[float, float]:
    """Return the radians, counter-clockwise, by which a hinged leaf at `start` and one at `end` turn to open.

    The sense is that of the RMF traffic editor and of its Gazebo worlds. The editor adds `motion_direction` times
    `motion_degrees` to the angle of the leaf in the image, whose y axis points down, so that with y up a positive
    direction is clockwise. The second leaf of a double door is the mirror image of the first.
    """
    angle = -math.copysign(math.radians(abs(door.motion_degrees)), door.motion_direction)
    return angle, -angle if door.motion == "double_hinged" else angle


def swept_areas(door: Door) -> list[Float]:
    """Return polygons f8[k,2] in metres that together cover the leaves at every opening; flat for sliding leaves."""
    shut, open_ = leaf_segments(door, 0.0), leaf_segments(door, 1.0)
    if "hinged" not in door.motion:
        return [np.concatenate([a, b]).reshape(-1, 2) for a, b in zip(shut, open_, strict=True)]
    arcs = np.stack([leaf_segments(door, share)[:, 2:] for share in np.linspace(0, 1, _STEPS)], axis=1)
    # The corners lie outside the arc, so that no chord cuts it.
    outside = 1 / math.cos(math.radians(door.motion_degrees) / (_STEPS - 1) / 2)
    return [
        np.concatenate([line[None, :2], line[:2] + outside * (arc - line[:2])])
        for line, arc in zip(shut, arcs, strict=True)
    ]


def _lengths(door: Door) -> tuple[float, float]:
    """Return the metres of the leaf at `start` and of the leaf at `end`; 0 means that there is none."""
    if door.motion.startswith("double"):
        first = door.width / (1 + door.right_left_ratio)
        return first, door.width - first
    return (door.width, 0.0) if door.motion_axis == "start" else (0.0, door.width)
