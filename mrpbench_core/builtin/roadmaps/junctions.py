"""Cuts lanes where they meet: at vertices that lie on them and where they cross.

The traffic editor allows a lane through a vertex, and two lanes that cross, without a connection between them. The
warehouse of the original benchmark has 14 components for that reason.
"""

import attrs
import numpy as np

from mrpbench_core.checking.components import components
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.common.geometry import point_segment_distance, side
from mrpbench_core.model.common.intervals import overlapping

ROUNDS = 20
"""Largest number of passes. A cut bends lanes by up to the tolerance, which may create new junctions; in practice two
or three passes suffice."""


@attrs.frozen
class LaneSegments:
    """The segments of lanes cut at their junctions."""

    position: Float
    """f8[V,2]: the given points that remain, in their order, then the crossings."""
    vertex: Int
    """i8[k]: the number of each given point."""
    ends: Int
    """i8[m,2]: start and end of each segment."""
    lane: Int
    """i8[m]: the lane of each segment, ascending."""


def cut_at_junctions(points: Float, lanes: Int, tolerance: float) -> LaneSegments:
    """Cut `lanes` i8[m,2] between `points` f8[k,2] where they meet.

    Points closer than `tolerance` metres become one vertex, the first of them. A lane that passes a vertex closer than
    `tolerance` leads through it. Segments keep the direction of their lane; a segment that shrinks to a point is
    dropped.
    """
    pieces = LaneSegments(points, np.arange(len(points)), lanes, np.arange(len(lanes)))
    for _ in range(ROUNDS):
        cut = _cut_once(pieces, tolerance)
        if len(cut.position) == len(pieces.position) and len(cut.ends) == len(pieces.ends):
            break
        pieces = cut
    return pieces


def _cut_once(pieces: LaneSegments, tolerance: float) -> LaneSegments:
    position, number = _merge(pieces.position, tolerance)
    vertex, ends = number[pieces.vertex], number[pieces.ends]
    crossing = _crossings(position[ends[:, 0]], position[ends[:, 1]], tolerance)
    position, number = _merge(np.concatenate([position, crossing]), tolerance)
    vertex, ends = number[vertex], number[ends]
    passed = np.split(ends, np.searchsorted(pieces.lane, np.arange(1, pieces.lane.max(initial=0) + 1)))
    stops = [_stops(position, a, b, passed[lane], tolerance) for (a, b), lane in zip(ends, pieces.lane, strict=True)]
    return LaneSegments(
        position=position,
        vertex=vertex,
        ends=np.concatenate([np.empty((0, 2), np.int64), *(np.stack([s[:-1], s[1:]], axis=1) for s in stops)]),
        lane=np.repeat(pieces.lane, [len(s) - 1 for s in stops]),
    )


def _merge(points: Float, tolerance: float) -> tuple[Float, Int]:
    """Return the distinct points in order of first use, and the number of each given point among them."""
    i, j = overlapping(points[:, 0] - tolerance / 2, points[:, 0] + tolerance / 2)
    near = np.hypot(*(points[i] - points[j]).T) < tolerance
    first = components(len(points), np.stack([i[near], j[near]], axis=1))
    distinct = first == np.arange(len(points))
    return points[distinct], (np.cumsum(distinct) - 1)[first]


def _crossings(start: Float, end: Float, tolerance: float) -> Float:
    """Return points f8[c,2] where the interiors of two lanes cross. A lane that ends on another is cut elsewhere."""
    i, j = overlapping(np.minimum(start, end)[:, 0], np.maximum(start, end)[:, 0])
    a, b, c, d = start[i], end[i], start[j], end[j]
    proper = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    a, b, c, d = a[proper], b[proper], c[proper], d[proper]
    ends = ((a, c, d), (b, c, d), (c, a, b), (d, a, b))
    gap = np.min([point_segment_distance(*three) for three in ends], axis=0)
    share = side(c, d, a) / (side(c, d, a) - side(c, d, b))
    crossing: Float = (a + share[:, None] * (b - a))[gap >= tolerance]
    return crossing


def _stops(position: Float, a: int, b: int, passed: Int, tolerance: float) -> Int:
    """Return the vertices between a and b in order of travel, with both ends; only a if b is the same vertex.

    A vertex that the lane has `passed` is not visited again: the lane would alternate between vertices close together.
    """
    if a == b:
        return np.array([a])
    start, end = position[a], position[b]
    on = point_segment_distance(position, start, end) < tolerance
    on[passed] = False
    on[[a, b]] = True
    stops = np.flatnonzero(on)
    share = (position[stops] - start) @ (end - start)
    share[stops == a], share[stops == b] = -np.inf, np.inf
    return stops[np.argsort(share, kind="stable")]
