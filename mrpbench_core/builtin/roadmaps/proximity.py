"""Finds the vertices and edges of a roadmap near polygons, and selects edges of a roadmap."""

import attrs
import numpy as np

from mrpbench_core.checking.clearance import touches
from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.planning.roadmap import Roadmap

MARGIN = 0.1
"""metres by which a robot may deviate from its position: the tolerance of navigators."""


def elements_near(outlines: list[Float], roadmap: Roadmap, levels: tuple[int, ...], radius: float) -> tuple[Int, Int]:
    """Return the vertices and edges on some levels at which a disc of `radius` metres touches a polygon f8[k,2]."""
    here = np.isin(roadmap.level, levels)
    start, end = roadmap.edges[:, 0], roadmap.edges[:, 1]
    flat = here[start] & here[end] & (roadmap.level[start] == roadmap.level[end])
    vertices, edges = np.flatnonzero(here), np.flatnonzero(flat)
    at, a, b = roadmap.position[vertices], roadmap.position[start[edges]], roadmap.position[end[edges]]
    stands, drives = np.zeros(len(at), bool), np.zeros(len(a), bool)
    for outline in outlines:
        stands |= touches(outline, at, at, radius)
        drives |= touches(outline, a, b, radius)
    return vertices[stands], edges[drives]


def select_edges(roadmap: Roadmap, chosen: Int) -> Roadmap:
    """Return the roadmap with only its edges `chosen` i8[k], in that order; its resources keep those edges."""
    number = np.full(len(roadmap.edges), -1)
    number[chosen] = np.arange(len(chosen))

    def renumbered(edges: tuple[int, ...]) -> tuple[int, ...]:
        return tuple(sorted(set(number[list(edges)].tolist()) - {-1}))

    return attrs.evolve(
        roadmap,
        edges=roadmap.edges[chosen],
        duration=roadmap.duration[:, chosen],
        resources=tuple(
            attrs.evolve(resource, edges=renumbered(resource.edges), passage=renumbered(resource.passage))
            for resource in roadmap.resources
        ),
    )
