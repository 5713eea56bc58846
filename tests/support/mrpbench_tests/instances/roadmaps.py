"""Roadmaps of tests: from points and edges, or drawn as rows of text."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from mrpbench_core.model.planning.roadmap import Roadmap

STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))


def roadmap(
    position: ArrayLike, edges: ArrayLike, duration: ArrayLike = 1, tick: float = 1.0, level: ArrayLike = 0
) -> Roadmap:
    """Directed edges i[E,2] between points f[V,2]; `duration` in ticks: one for all, i[E], or i[profiles,E]."""
    ends = np.asarray(edges, np.int32).reshape(-1, 2)
    count = len(np.asarray(position))
    ticks = np.atleast_2d(duration)
    return Roadmap(
        position=np.asarray(position, float).reshape(-1, 2),
        level=np.broadcast_to(level, count).astype(np.int16),
        heading=np.full(count, np.nan),
        edges=ends,
        duration=np.broadcast_to(ticks, (len(ticks), len(ends))).astype(np.int32),
        tick=tick,
    )


def two_way(
    position: ArrayLike,
    pairs: Sequence[tuple[int, int]],
    duration: ArrayLike = 1,
    tick: float = 1.0,
    level: ArrayLike = 0,
) -> Roadmap:
    """Lanes in both directions, edges 2i and 2i + 1 for pair i; `duration` in ticks, for all lanes or each."""
    edges = [edge for a, b in pairs for edge in ((a, b), (b, a))]
    ticks = np.repeat(np.broadcast_to(duration, len(pairs)), 2)
    return roadmap(position, edges, ticks, tick, level)


def two_way_grid(rows: int, columns: int, size: float = 1.0, duration: int = 1) -> Roadmap:
    """A four-connected grid of `size` metres with lanes in both directions; vertex = row * columns + column."""
    cells = range(rows * columns)
    pairs = [(v, v + 1) for v in cells if (v + 1) % columns] + [(v, v + columns) for v in cells[:-columns]]
    return two_way([(v % columns * size, v // columns * size) for v in cells], pairs, duration)


def grid_of(rows: Sequence[str]) -> Roadmap:
    """A four-connected unit grid of the cells that are `.`; vertices in reading order, y upwards."""
    cells = [(y, x) for y, row in enumerate(rows) for x, cell in enumerate(row) if cell == "."]
    index = {cell: vertex for vertex, cell in enumerate(cells)}
    edges = [
        (vertex, index[y + dy, x + dx])
        for (y, x), vertex in index.items()
        for dy, dx in STEPS
        if (y + dy, x + dx) in index
    ]
    return roadmap([(x, -y) for y, x in cells], edges)
