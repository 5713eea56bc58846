"""Distances between points and straight segments, vectorised."""

import numpy as np

from mrpbench_core.model.arrays import Float


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
    crossing = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    result: Float = np.where(crossing, 0.0, distance)
    return result


def side(start: Float, end: Float, point: Float) -> Float:
    """Twice the signed area of the triangle: positive where `point` lies left of `start`-`end`."""
    ahead, offset = end - start, point - start
    area: Float = ahead[..., 0] * offset[..., 1] - ahead[..., 1] * offset[..., 0]
    return area
