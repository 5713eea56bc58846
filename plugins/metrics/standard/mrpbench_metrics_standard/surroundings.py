"""Distances of each robot from the nearest other robot and from the nearest solid thing."""

import numpy as np
from scipy.spatial import cKDTree

from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16
from mrpbench_core.model.common.geometry import point_segment_distance

APART = 1e6
"""metres between levels in the search for neighbours: farther than any two places on one level."""
TILES = (8.0, 1.0)
"""metres: sides of the tiles within which segments that are nearest to no place are dropped."""
TOGETHER = 2**20
"""Pairs of point and segment that are compared at once: bounds memory."""


def robot_gaps(position: Float, level: Int16, radii: Float, chosen: Bool) -> Float:
    """Gap in metres between the discs of each chosen robot and of the nearest other robot on its level.

    The result is exact: robots of one radius are searched together, and among them the nearest centre has the nearest
    surface.

    Args:
        position: f8[T,n,2] metres.
        level: i2[T,n].
        radii: f8[n] metres.
        chosen: bool[T,n], the robots and samples whose gaps are wanted.

    Returns:
        f8[k], by sample and robot; robots that are alone on their level are left out.
    """
    place = np.concatenate([position, level[..., None] * APART], axis=2)
    kinds = [(radius, np.flatnonzero(radii == radius)) for radius in np.unique(radii)]
    gaps = [np.empty(0)]
    for sample in np.flatnonzero(chosen.any(axis=1)):
        asking = np.flatnonzero(chosen[sample])
        nearest = np.full(len(asking), np.inf)
        for radius, kind in kinds:
            # The nearest of a robot's own kind is the robot itself, or one that stands at the same place.
            away = np.asarray(cKDTree(place[sample, kind]).query(place[sample, asking], k=[1, 2])[0])
            away = np.where(radii[asking] == radius, away[:, 1], away[:, 0])
            nearest = np.minimum(nearest, np.where(away < APART / 2, away - radius, np.inf))
        gaps.append((nearest - radii[asking])[np.isfinite(nearest)])
    return np.concatenate(gaps)


def solid_distances(points: Float, segments: Float) -> Float:
    """Distance f8[k] in metres of each of `points` f8[k,2] from the nearest of `segments` f8[S,4]; inf without any.

    The result is exact: each tile keeps the segments that may be nearest to a place in it. The distance of a place from
    anything differs from that of the tile's centre by half a diagonal at most.
    """
    found = np.full(len(points), np.inf)
    if len(points) and len(segments):
        _search(points, np.arange(len(points)), segments, TILES, found)
    return found


def _search(points: Float, chosen: Int, segments: Float, sides: tuple[float, ...], found: Float) -> None:
    if not sides:
        start, end = segments[:, :2], segments[:, 2:]
        for part in np.array_split(chosen, 1 + len(chosen) * len(segments) // TOGETHER):
            found[part] = point_segment_distance(points[part][:, None], start, end).min(axis=1)
        return
    side = sides[0]
    tile = np.floor(points[chosen] / side).astype(np.int64)
    order = np.lexsort(tile.T)
    chosen, tile = chosen[order], tile[order]
    ends = np.flatnonzero((np.diff(tile, axis=0) != 0).any(axis=1)) + 1
    for inside, first in zip(np.split(chosen, ends), np.append(0, ends), strict=True):
        away = point_segment_distance((tile[first] + 0.5) * side, segments[:, :2], segments[:, 2:])
        near = away <= away.min() + side * np.sqrt(2) + 1e-9
        _search(points, inside, segments[near], sides[1:], found)
