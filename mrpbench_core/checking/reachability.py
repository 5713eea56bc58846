"""Who can get where on a roadmap, without the code of any planner."""

import numpy as np

from mrpbench_core.checking.components import components
from mrpbench_core.model.arrays import Bool, Int, Int32
from mrpbench_core.model.roadmap import Roadmap


def reachable(roadmap: Roadmap, profile: int, source: int) -> Bool:
    """Which vertices bool[V] a robot of a motion profile can reach from `source` (itself included)."""
    edges = _usable(roadmap, profile)
    order = np.argsort(edges[:, 0], kind="stable")
    first = np.searchsorted(edges[order, 0], np.arange(len(roadmap.position) + 1))
    head = edges[order, 1]
    seen = np.zeros(len(roadmap.position), bool)
    seen[source] = True
    frontier = np.array([source])
    while len(frontier):
        found = head[_rows(first, frontier)]
        frontier = np.unique(found[~seen[found]])
        seen[frontier] = True
    return seen


def round_trips(roadmap: Roadmap, profile: int) -> Int:
    """Label i8[V] of each vertex: equal where robots of a motion profile can drive there *and back*."""
    edges = _usable(roadmap, profile)
    count = len(roadmap.position)
    forth = np.sort(edges[:, 0].astype(np.int64) * count + edges[:, 1])
    back = np.sort(edges[:, 1].astype(np.int64) * count + edges[:, 0])
    if np.array_equal(forth, back):
        return components(count, edges)
    return _directed_components(count, edges)


def _usable(roadmap: Roadmap, profile: int) -> Int32:
    usable: Int32 = roadmap.edges[roadmap.duration[profile] >= 0]
    return usable


def _rows(first: Int, rows: Int) -> Int:
    """The positions of all elements of some rows of a compressed sparse matrix."""
    counts = first[rows + 1] - first[rows]
    skipped = np.cumsum(counts) - counts
    positions: Int = np.repeat(first[rows] - skipped, counts) + np.arange(counts.sum())
    return positions


def _directed_components(count: int, edges: Int32) -> Int:
    """Strongly connected components; Tarjan, "Depth-first search and linear graph algorithms", SIAM J. Comput. 1972."""
    after: list[list[int]] = [[] for _ in range(count)]
    for tail, head in edges.tolist():
        after[tail].append(head)
    label, low, open_vertices = [-1] * count, [-1] * count, []
    visits = 0
    for root in range(count):
        if low[root] >= 0:
            continue
        walk: list[tuple[int, int]] = [(root, 0)]
        seen_at = {}
        while walk:
            vertex, index = walk.pop()
            if index == 0:
                seen_at[vertex] = low[vertex] = visits
                visits += 1
                open_vertices.append(vertex)
            elif label[child := after[vertex][index - 1]] < 0:
                low[vertex] = min(low[vertex], low[child])
            while index < len(after[vertex]) and low[after[vertex][index]] >= 0:
                if label[child := after[vertex][index]] < 0:
                    low[vertex] = min(low[vertex], low[child])
                index += 1
            if index < len(after[vertex]):
                walk += [(vertex, index + 1), (after[vertex][index], 0)]
            elif low[vertex] == seen_at[vertex]:
                while label[vertex] < 0:
                    label[open_vertices.pop()] = vertex
    return np.array(label, np.int64)
