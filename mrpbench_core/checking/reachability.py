"""Finds which vertices of a roadmap robots can reach, without code of planners."""

import numpy as np

from mrpbench_core.checking.components import components
from mrpbench_core.checking.strong_components import strong_components
from mrpbench_core.model.common.arrays import Bool, Int, Int32
from mrpbench_core.model.planning.roadmap import Roadmap


def reachable(roadmap: Roadmap, profile: int, source: int) -> Bool:
    """Tell bool[V] which vertices a robot of a motion profile can reach from `source` (included)."""
    edges = _usable(roadmap, profile)
    order = np.argsort(edges[:, 0], kind="stable")
    first = np.searchsorted(edges[order, 0], np.arange(len(roadmap.position) + 1))
    head = edges[order, 1]
    visited = np.zeros(len(roadmap.position), bool)
    visited[source] = True
    frontier = np.array([source])
    while len(frontier):
        neighbors = head[_rows(first, frontier)]
        frontier = np.unique(neighbors[~visited[neighbors]])
        visited[frontier] = True
    return visited


def round_trips(roadmap: Roadmap, profile: int) -> Int:
    """Label i8[V] of each vertex: equal for vertices between which a motion profile can drive both ways."""
    edges = _usable(roadmap, profile)
    count = len(roadmap.position)
    forth = np.sort(edges[:, 0].astype(np.int64) * count + edges[:, 1])
    back = np.sort(edges[:, 1].astype(np.int64) * count + edges[:, 0])
    if np.array_equal(forth, back):
        return components(count, edges)
    label = np.arange(count)
    for group in strong_components(edges[:, 0].tolist(), edges[:, 1].tolist()):
        label[list(group)] = group[0]
    return label


def _usable(roadmap: Roadmap, profile: int) -> Int32:
    usable: Int32 = roadmap.edges[roadmap.duration[profile] >= 0]
    return usable


def _rows(first: Int, rows: Int) -> Int:
    """The indices of all elements of some rows of a compressed sparse matrix."""
    counts = first[rows + 1] - first[rows]
    skipped = np.cumsum(counts) - counts
    positions: Int = np.repeat(first[rows] - skipped, counts) + np.arange(counts.sum())
    return positions
