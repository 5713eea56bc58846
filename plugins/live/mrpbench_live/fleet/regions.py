"""Plane geometry of zones and corridors: which ways and bodies touch a polygon, and how far places are off a line."""

import numpy as np

from mrpbench_core.api import Float
from mrpbench_core.model.common.geometry import inside, point_segment_distance, segment_distance, side
from mrpbench_core.model.common.poses import composed


def clearance(tail: Float, head: Float, polygon: Float) -> Float:
    """Return the metres f8[k] from straight ways to a simple polygon f8[m,2]; 0 for those that touch it.

    Args:
        tail: f8[k,2] where the ways begin.
        head: f8[k,2] where they end.
        polygon: its corners, in metres.
    """
    sides = segment_distance(tail[:, None], head[:, None], polygon, np.roll(polygon, -1, axis=0))
    found: Float = np.where(inside(polygon, tail), 0.0, sides.min(axis=1))
    return found


def touches(body: Float, polygon: Float) -> bool:
    """Tell whether two simple polygons f8[k,2] and f8[m,2] touch or overlap."""
    if (body.max(axis=0) < polygon.min(axis=0)).any() or (body.min(axis=0) > polygon.max(axis=0)).any():
        return False
    sides = clearance(body, np.roll(body, -1, axis=0), polygon)
    return bool((sides <= 0.0).any() or inside(body, polygon[0]))


def offsets(place: Float, line: Float) -> Float:
    """Return how many metres f8[p] places f8[p,2] are to the left of a line f8[k,2], k > 1; right is negative.

    The leg of the line that is nearest to a place decides; the first and the last one count as longer than they are.
    """
    nearest = point_segment_distance(place[:, None], line[:-1], line[1:]).argmin(axis=1)
    tail, head = line[nearest], line[nearest + 1]
    found: Float = side(tail, head, place) / np.hypot(*(head - tail).T)
    return found


def placed(footprint: Float, pose: tuple[float, float, float]) -> Float:
    """Return the corners f8[k,2] of a footprint f8[k,2] at a pose: x, y (metres), yaw (radians)."""
    corners = np.column_stack([footprint, np.zeros(len(footprint))])
    return composed(np.array(pose), corners)[:, :2]
