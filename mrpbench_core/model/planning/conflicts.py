"""The only definition of a conflict, which planners, validators and dispatchers share.

Time is in ticks. A robot stands at a vertex during the *closed* interval [arrive, depart] and is on an edge during the
*open* interval (enter, leave). Two robots conflict when

1. *vertex*: they stand at one vertex at the same tick;
2. *swap*: they are on an edge and its reverse at the same time;
3. *overtaking*: they are on one directed edge at the same time and the first to enter is not the first to leave;
4. *following* (only with `rules.following: forbidden`): one is on an edge into a vertex while another is on an edge out
   of it, or both are on one directed edge;
5. *footprint* (only with the feature `footprints`): they occupy, at the same time, two elements (vertices, or edges as
   straight segments, also ones that share an end) that are closer than the sum of their radii;
6. *resource*: they are among more robots than its `capacity` that use a resource of the roadmap at one time. A robot
   uses it while it is on one of its elements and for `setup_ticks` ticks afterwards.

With `rules.k` the plan is *k-robust* (Atzmon et al., "Robust Multi-Agent Path Finding and Executing", JAIR 2020): no
conflict although each robot is up to k ticks late anywhere. A robot that comes in time and leaves k ticks late is in
the way longest, so each stay at a vertex and each time on an edge ends k ticks later for these rules.

With unit durations, rules 1 and 2 are the vertex and edge conflicts of Stern et al., "Multi-Agent Pathfinding:
Definitions, Variants, and Benchmarks", SoCS 2019; rule 5 is the multi-agent path finding with large agents of Li et
al., AAAI 2019, on discs and straight lanes.
"""

from typing import NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int32
from mrpbench_core.model.common.geometry import segment_distance
from mrpbench_core.model.common.intervals import overlapping
from mrpbench_core.model.planning.roadmap import Roadmap

TOLERANCE = 1e-9
"""metres: elements exactly two radii apart do not exclude one another."""


class Exclusions(NamedTuple):
    """The elements of a roadmap that are closer than a distance, as sparse rows sorted by element.

    Element v < V is a vertex, element V + e is edge e. Row x lists the *other* elements near x (and x itself).
    """

    first: Int
    """i8[V+E+1]: row x is `element[first[x]:first[x + 1]]`."""
    element: Int32
    """i4[...]."""
    distance: Float
    """f8[...] metres."""


def exclusions(roadmap: Roadmap, distance: float) -> Exclusions:
    """Find all pairs of elements of one level closer than `distance` metres (rule 5), each in both orders."""
    vertices = np.arange(len(roadmap.position))
    start = np.concatenate([vertices, roadmap.edges[:, 0]]).astype(np.int64)
    end = np.concatenate([vertices, roadmap.edges[:, 1]]).astype(np.int64)
    # Elements at one place, such as headings, turns and both directions of a lane, share a row, which is found once.
    place = np.unique(np.column_stack([roadmap.position, roadmap.level]), axis=0, return_inverse=True)[1].ravel()
    ends = np.sort(np.stack([place[start], place[end]]), axis=0)
    _, sample, shape = np.unique(ends, axis=1, return_index=True, return_inverse=True)
    shape = shape.ravel()
    left, right, gap = _near(roadmap, start[sample], end[sample], distance)
    by_shape, first_of = np.argsort(shape, kind="stable"), np.searchsorted(np.sort(shape), np.arange(len(sample) + 1))
    size = np.diff(first_of)[right]
    row, gap = np.repeat(left, size), np.repeat(gap, size)
    element = by_shape[np.arange(len(row)) + np.repeat(first_of[right] - np.cumsum(size) + size, size)]
    order = np.lexsort((element, row))
    element, gap = element[order].astype(np.int32), gap[order]
    begin = np.searchsorted(row[order], np.arange(len(sample) + 1))
    size = np.diff(begin)[shape]
    first = np.concatenate([[0], np.cumsum(size)])
    index = np.arange(first[-1]) + np.repeat(begin[shape] - first[:-1], size)
    return Exclusions(first, element[index], gap[index])


def _near(roadmap: Roadmap, start: Int, end: Int, distance: float) -> tuple[Int, Int, Float]:
    """Ordered pairs i8[k] of segments between vertices i8[m] that share a level and are near, and their distances."""
    left, right = _near_boxes(roadmap.position[start], roadmap.position[end], distance)
    low, high = roadmap.level[start], roadmap.level[end]
    shared = (low[left] == low[right]) | (high[left] == high[right])
    shared |= (low[left] == high[right]) | (high[left] == low[right])
    left, right = left[shared], right[shared]
    a, b, c, d = (roadmap.position[ends] for ends in (start[left], end[left], start[right], end[right]))
    gap = segment_distance(a, b, c, d)
    near = gap < distance - TOLERANCE
    return left[near], right[near], gap[near]


def _near_boxes(start: Float, end: Float, distance: float) -> tuple[Int, Int]:
    """Ordered pairs of segments whose bounding boxes, grown by `distance`, meet, and each with itself."""
    low, high = np.minimum(start, end) - distance / 2, np.maximum(start, end) + distance / 2
    left, right = overlapping(low[:, 0], high[:, 0])
    meet = (low[left, 1] <= high[right, 1]) & (low[right, 1] <= high[left, 1])
    left, right = left[meet], right[meet]
    same = np.arange(len(start))
    return np.concatenate([same, left, right]), np.concatenate([same, right, left])
