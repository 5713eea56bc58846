"""Lengths of the shortest paths on a roadmap."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.problem import Problem

TOGETHER = 2**23
"""Pairs of source and vertex searched at once: bounds memory to some 64 MB."""


def shortest_lengths(problem: Problem) -> Float:
    """Metres f8[n] of the shortest path of each robot, alone, from its start through its goals in order; inf = none."""
    lengths = np.zeros(len(problem))
    for profile in np.unique(problem.profile):
        robots = np.flatnonzero(problem.profile == profile)
        stages = {robot: [(int(problem.start[robot]),), *problem.goals[robot]] for robot in robots}
        sources = sorted({vertex for own in stages.values() for stage in own[:-1] for vertex in stage})
        targets = sorted({vertex for own in stages.values() for stage in own[1:] for vertex in stage})
        if not targets:
            continue
        length = _lengths(_graph(problem, int(profile)), sources, targets)
        row, column = ({vertex: index for index, vertex in enumerate(names)} for names in (sources, targets))
        for robot, own in stages.items():
            so_far = np.zeros(1)
            for before, after in pairwise(own):
                leg = length[np.ix_([row[vertex] for vertex in before], [column[vertex] for vertex in after])]
                so_far = (so_far[:, None] + leg).min(axis=0)
            lengths[robot] = so_far.min()
    return lengths


def _graph(problem: Problem, profile: int) -> csr_array:
    """The edges that the profile may use, weighted with their lengths; one of several parallel edges."""
    roadmap, count = problem.roadmap, len(problem.roadmap.position)
    ends = np.unique(roadmap.edges[roadmap.duration[profile] >= 0], axis=0)
    span = roadmap.position[ends[:, 1]] - roadmap.position[ends[:, 0]]
    return csr_array((np.hypot(span[:, 0], span[:, 1]), (ends[:, 0], ends[:, 1])), shape=(count, count))


def _lengths(graph: csr_array, sources: Sequence[int], targets: Sequence[int]) -> Float:
    """Metres f8[sources,targets]."""
    found = np.empty((len(sources), len(targets)))
    together = max(1, TOGETHER // graph.shape[0])
    asked: Int = np.asarray(sources)
    for begin in range(0, len(asked), together):
        part = slice(begin, begin + together)
        found[part] = dijkstra(graph, indices=asked[part])[:, targets]
    return found
