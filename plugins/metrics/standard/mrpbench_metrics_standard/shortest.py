"""Lengths of the shortest paths on a roadmap."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from mrpbench_native.mapf import path_lengths

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.planning.problem import Problem


def shortest_lengths(problem: Problem) -> Float:
    """Metres f8[n] of the shortest path of each robot, alone, from its start through its goals in order; inf = none."""
    lengths = np.zeros(len(problem))
    for profile in np.unique(problem.profile):
        robots = np.flatnonzero(problem.profile == profile)
        stages = {robot: [(int(problem.start[robot]),), *problem.goals[robot]] for robot in robots}
        sources = sorted({vertex for of_robot in stages.values() for stage in of_robot[:-1] for vertex in stage})
        targets = sorted({vertex for of_robot in stages.values() for stage in of_robot[1:] for vertex in stage})
        if not targets:
            continue
        length = _lengths(problem, int(profile), sources, targets)
        row, column = ({vertex: index for index, vertex in enumerate(names)} for names in (sources, targets))
        for robot, of_robot in stages.items():
            so_far = np.zeros(1)
            for before, after in pairwise(of_robot):
                leg = length[np.ix_([row[vertex] for vertex in before], [column[vertex] for vertex in after])]
                so_far = (so_far[:, None] + leg).min(axis=0)
            lengths[robot] = so_far.min()
    return lengths


def _lengths(problem: Problem, profile: int, sources: Sequence[int], targets: Sequence[int]) -> Float:
    """Metres f8[sources,targets] on the edges that the profile may use."""
    edges = problem.roadmap.edges[problem.roadmap.duration[profile] >= 0]
    span = problem.roadmap.position[edges[:, 1]] - problem.roadmap.position[edges[:, 0]]
    return path_lengths(
        len(problem.roadmap.position),
        edges,
        np.hypot(span[:, 0], span[:, 1]),
        np.asarray(sources, np.int32),
        np.asarray(targets, np.int32),
    )
