"""Distances between points and straight segments, vectorised."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float


def point_segment_distance(points: Float, start: Float, end: Float) -> Float:
    """Distances f8[...] in metres of `points` f8[...,2] from segments `start`-`end` f8[...,2] (broadcast)."""
    along = end - start
    squared = (along * along).sum(-1)
    offset = points - start
    share = np.clip((offset * along).sum(-1) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    gap = offset - share[..., None] * along
    distance: Float = np.hypot(gap[..., 0], gap[..., 1])
    return distance


def segment_distance(a: Float, b: Float, c: Float, d: Float) -> Float:
    """Distances f8[...] in metres between segments `a`-`b` and `c`-`d` f8[...,2] (broadcast); 0 where they cross."""
    distance = np.minimum(
        np.minimum(point_segment_distance(a, c, d), point_segment_distance(b, c, d)),
        np.minimum(point_segment_distance(c, a, b), point_segment_distance(d, a, b)),
    )
    # Sides of collinear segments are rounding errors; such segments can only cross where their boxes overlap.
    low, high = np.maximum(np.minimum(a, b), np.minimum(c, d)), np.minimum(np.maximum(a, b), np.maximum(c, d))
    crossing = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0) & (low <= high).all(axis=-1)
    result: Float = np.where(crossing, 0.0, distance)
    return result


def inside(outline: Float, points: Float) -> Bool:
    """Tell bool[...] whether `points` f8[...,2] lie inside closed polygons f8[...,k,2] (broadcast), by the even-odd
    rule: a ray to the right from an inner point crosses the outline an odd number of times.
    """
    after = np.roll(outline, -1, axis=-2)
    rise, along = after[..., 1] - outline[..., 1], after[..., 0] - outline[..., 0]
    dx, dy = points[..., None, 0] - outline[..., 0], points[..., None, 1] - outline[..., 1]
    straddles = (dy < 0) != (points[..., None, 1] < after[..., 1])
    left_of = np.where(rise > 0, dx * rise < dy * along, dx * rise > dy * along)
    odd: Bool = (straddles & left_of).sum(axis=-1) % 2 == 1
    return odd


def side(start: Float, end: Float, point: Float) -> Float:
    """Twice the signed area of the triangle: positive where `point` lies left of `start`-`end`."""
    ahead, offset = end - start, point - start
    area: Float = ahead[..., 0] * offset[..., 1] - ahead[..., 1] * offset[..., 0]
    return area


def facing(waypoints: Float) -> Float:
    """Return waypoints f8[k,3] in which each open yaw (NaN) is the direction of the next move, or else of the last."""
    turned = np.array(waypoints)
    ahead = np.diff(turned[:, :2], axis=0)
    moves = (ahead != 0).any(axis=1)
    yaw = 0.0
    if moves.any():
        first = ahead[moves][0]
        yaw = float(np.arctan2(first[1], first[0]))
    for index in range(len(turned)):
        if index < len(ahead) and moves[index]:
            yaw = float(np.arctan2(ahead[index, 1], ahead[index, 0]))
        if np.isnan(turned[index, 2]):
            turned[index, 2] = yaw
    return turned
