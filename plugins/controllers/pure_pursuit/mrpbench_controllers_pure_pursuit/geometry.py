"""The point of a path that a pursuing robot aims at, and how fast it may go to stop in time."""

import math
from collections.abc import Sequence
from itertools import pairwise

Point = Sequence[float]


def carrot(path: Sequence[Point], x: float, y: float, distance: float) -> tuple[float, float]:
    """The first point of a path, prolonged straight beyond its end, that is `distance` metres from (x, y).

    When the path begins farther away than that, its first point.
    """
    px, py = path[0]
    if math.hypot(px - x, py - y) >= distance:
        return px, py
    dx, dy = 0.0, 0.0
    for qx, qy in path[1:]:
        if qx != px or qy != py:
            dx, dy = qx - px, qy - py
            if math.hypot(qx - x, qy - y) >= distance:
                break
        px, py = qx, qy
    length = math.hypot(dx, dy)
    if length == 0:  # all of the path is one point
        return px, py
    # (px, py) lies inside the circle around (x, y); the ray from there along the leg leaves it once.
    dx, dy = dx / length, dy / length
    along = (x - px) * dx + (y - py) * dy
    beside = (x - px) * dy - (y - py) * dx
    share = along + math.sqrt(max(distance * distance - beside * beside, 0.0))
    return px + share * dx, py + share * dy


def path_length(path: Sequence[Point], enough: float) -> float:
    """Length of a path in metres; at least `enough` when it is longer than that."""
    length = 0.0
    for start, end in pairwise(path):
        length += math.hypot(end[0] - start[0], end[1] - start[1])
        if length >= enough:
            break
    return length


def stopping_speed(distance: float, acceleration: float, period: float) -> float:
    """The highest speed kept for one period from which the robot can still stop within `distance`."""
    return acceleration * (math.sqrt(period * period + 2 * distance / acceleration) - period)
