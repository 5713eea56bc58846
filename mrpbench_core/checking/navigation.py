"""Finds places where a drawn navigation graph looks connected but is not."""

from collections import defaultdict

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import point_segment_distance, side
from mrpbench_core.model.worlds.world import World

TOLERANCE = 0.05
"""Metres: a vertex closer than this to a lane looks as if it were on the lane."""

Pair = tuple[int, int]


def unique_edges(world: World) -> list[Pair]:
    """The lanes as sorted pairs of vertices, each once; the last of several vertices at one position stands for all."""
    return sorted(_graphs_of_edges(world))


def graphs(world: World) -> list[set[int]]:
    """The navigation graphs of the lanes at each vertex."""
    of: list[set[int]] = [set() for _ in world.vertices]
    for lane in world.lanes:
        of[lane.start].add(lane.graph)
        of[lane.end].add(lane.graph)
    return of


def _graphs_of_edges(world: World) -> dict[Pair, set[int]]:
    last = {(vertex.x, vertex.y, vertex.level): index for index, vertex in enumerate(world.vertices)}
    number = [last[vertex.x, vertex.y, vertex.level] for vertex in world.vertices]
    of: dict[Pair, set[int]] = defaultdict(set)
    for lane in world.lanes:
        start, end = number[lane.start], number[lane.end]
        of[min(start, end), max(start, end)].add(lane.graph)
    return of


def duplicates(world: World) -> list[tuple[int, ...]]:
    """Groups of vertices at one position."""
    groups: dict[tuple[float, float, int], list[int]] = {}
    for index, vertex in enumerate(world.vertices):
        groups.setdefault((vertex.x, vertex.y, vertex.level), []).append(index)
    return [tuple(group) for group in groups.values() if len(group) > 1]


def vertices_on_lanes(world: World) -> list[tuple[int, Pair]]:
    """Vertices on an edge of their graph that does not end there, with that edge."""
    point, level = _positions(world)
    of = graphs(world)
    overlaps = []
    for (a, b), graphs_of_edge in sorted(_graphs_of_edges(world).items()):
        near = (point_segment_distance(point, point[a], point[b]) < TOLERANCE) & (level == level[a])
        ends = np.minimum(np.hypot(*(point - point[a]).T), np.hypot(*(point - point[b]).T))
        inside = np.flatnonzero(near & (ends >= TOLERANCE)).tolist()
        overlaps += [(vertex, (a, b)) for vertex in inside if not of[vertex] or of[vertex] & graphs_of_edge]
    return overlaps


def crossings(world: World) -> list[tuple[Pair, Pair]]:
    """Edges of one graph that cross without a common vertex."""
    point, level = _positions(world)
    of = _graphs_of_edges(world)
    edges = np.array(sorted(of), np.int64).reshape(-1, 2)
    pairs: list[tuple[Pair, Pair]] = []
    for index, (a, b) in enumerate(edges.tolist()):
        c, d = edges[index + 1 :].T
        apart = side(point[a], point[b], point[c]) * side(point[a], point[b], point[d]) < 0
        apart &= side(point[c], point[d], point[a]) * side(point[c], point[d], point[b]) < 0
        later = np.flatnonzero(apart & (level[c] == level[a]))
        crossed = [(int(c[other]), int(d[other])) for other in later.tolist()]
        pairs += [((a, b), other) for other in crossed if of[a, b] & of[other]]
    return pairs


def called(world: World, index: int) -> str:
    """The name of a vertex, or its position if it has none."""
    vertex = world.vertices[index]
    return vertex.name or f"({vertex.x:.2f}, {vertex.y:.2f})"


def _positions(world: World) -> tuple[Float, Float]:
    values = np.array([(vertex.x, vertex.y, vertex.level) for vertex in world.vertices]).reshape(-1, 3)
    return values[:, :2], values[:, 2]
