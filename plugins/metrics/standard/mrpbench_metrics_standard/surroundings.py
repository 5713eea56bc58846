"""Distances of each robot from the nearest other robot and from the nearest solid thing."""

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16
from mrpbench_core.model.common.geometry import point_segment_distance

TILES = (8.0, 1.0)
"""metres: sides of the tiles within which segments that are nearest to no place are dropped."""
TOGETHER = 2**20
"""Pairs of point and segment that are compared at once: bounds memory."""


def robot_gaps(position: Float, level: Int16, radii: Float, chosen: Bool) -> Float:
    """Gap in metres between the discs of each chosen robot and of the nearest other robot on its level.

    The result is exact. Robots are sorted along x, and each looks at the next ones until those are, along x alone,
    farther than the nearest so far.

    Args:
        position: f8[T,n,2] metres.
        level: i2[T,n].
        radii: f8[n] metres.
        chosen: bool[T,n], the robots and samples whose gaps are wanted.

    Returns:
        f8[k], by sample and robot; robots that are alone on their level are left out.
    """
    gaps = [np.empty(0)]
    samples = max(1, TOGETHER // max(1, len(radii)))
    for begin in range(0, len(position), samples):
        part = slice(begin, begin + samples)
        place, gap = position[part].reshape(-1, 2), np.full(chosen[part].size, np.inf)
        floor = (
            np.arange(len(level[part]))[:, None] * (int(level.max()) + 1) + level[part]
        )  # equal on one level at a time
        order = np.lexsort((place[:, 0], floor.ravel()))
        x, y = place[order].T
        radius, asking, here = (
            np.tile(radii, len(level[part]))[order],
            chosen[part].ravel()[order],
            floor.ravel()[order],
        )
        _look_ahead(x, y, radius, here, asking, gap)
        _look_ahead(-x[::-1], y[::-1], radius[::-1], here[::-1], asking[::-1], gap[::-1])
        gap[order] = gap.copy()
        gaps.append(gap[np.isfinite(gap)])
    return np.concatenate(gaps)


def _look_ahead(x: Float, y: Float, radius: Float, floor: Int, chosen: Bool, gap: Float) -> None:
    """Lower the gaps of the chosen robots to those of the nearest robots of the same floor that follow in the arrays.

    All arrays are sorted by floor, then by x.
    """
    active, ahead = np.flatnonzero(chosen), 0
    while len(active):
        ahead += 1
        active = active[active + ahead < len(x)]
        near = floor[active + ahead] == floor[active]
        near &= x[active + ahead] - x[active] - radius[active] - radius.max() < gap[active]
        active = active[near]
        other = active + ahead
        away = np.hypot(x[other] - x[active], y[other] - y[active]) - radius[active] - radius[other]
        gap[active] = np.minimum(gap[active], away)


def solid_distances(points: Float, segments: Float) -> Float:
    """Distance f8[k] in metres of each of `points` f8[k,2] from the nearest of `segments` f8[S,4]; inf without any.

    The result is exact: each tile keeps the segments that may be nearest to a place in it. The distance of a place from
    anything differs from that of the tile's centre by half a diagonal at most.
    """
    distances = np.full(len(points), np.inf)
    if len(points) and len(segments):
        _search(points, np.arange(len(points)), segments, TILES, distances)
    return distances


def _search(points: Float, chosen: Int, segments: Float, sides: tuple[float, ...], distances: Float) -> None:
    if not sides:
        start, end = segments[:, :2], segments[:, 2:]
        for part in np.array_split(chosen, 1 + len(chosen) * len(segments) // TOGETHER):
            distances[part] = point_segment_distance(points[part][:, None], start, end).min(axis=1)
        return
    side = sides[0]
    tile = np.floor(points[chosen] / side).astype(np.int64)
    order = np.lexsort(tile.T)
    chosen, tile = chosen[order], tile[order]
    ends = np.flatnonzero((np.diff(tile, axis=0) != 0).any(axis=1)) + 1
    for inside, first in zip(np.split(chosen, ends), np.append(0, ends), strict=True):
        away = point_segment_distance((tile[first] + 0.5) * side, segments[:, :2], segments[:, 2:])
        near = away <= away.min() + side * np.sqrt(2) + 1e-9
        _search(points, inside, segments[near], sides[1:], distances)
