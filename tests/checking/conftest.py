"""Small roadmaps, problems and plans for the tests of validators."""

from types import SimpleNamespace

import attrs
import numpy as np
import pytest

from mrpbench_core.model.plan import Path
from mrpbench_core.model.problem import Problem, features_of
from mrpbench_core.model.roadmap import Roadmap


def roadmap(points, pairs, ticks=1, level=None) -> Roadmap:
    """Two-way lanes `pairs` between `points`, all of `ticks`."""
    edges = [edge for a, b in pairs for edge in ((a, b), (b, a))]
    return Roadmap(
        position=points,
        level=np.zeros(len(points)) if level is None else level,
        heading=np.full(len(points), np.nan),
        edges=edges,
        duration=np.full((1, len(edges)), ticks),
        tick=1.0,
    )


def grid(rows: int, columns: int, ticks=1) -> Roadmap:
    """A four-connected unit grid; vertex = row * columns + column."""
    cells = range(rows * columns)
    pairs = [(v, v + 1) for v in cells if (v + 1) % columns] + [(v, v + columns) for v in cells[:-columns]]
    return roadmap([(v % columns, v // columns) for v in cells], pairs, ticks)


def path(roadmap: Roadmap, *steps) -> Path:
    """A path of steps (from, to, leave tick), the first from tick 0; a step from a vertex to itself is a wait."""
    edges = {(int(a), int(b)): edge for edge, (a, b) in enumerate(roadmap.edges)}
    leave = [tick for _, _, tick in steps]
    return Path(edge=[edges.get((a, b), -1) for a, b, _ in steps], enter=[0, *leave][: len(leave)], leave=leave)


def problem(roadmap: Roadmap, starts, goals=None, features=frozenset(), radius=0.1, **fields) -> Problem:
    """Robots at `starts` that may end anywhere, unless `goals` are given."""
    made = Problem(
        roadmap=roadmap,
        profile=np.zeros(len(starts)),
        radius=np.broadcast_to(radius, len(starts)),
        start=starts,
        ready=fields.pop("ready", np.zeros(len(starts))),
        goals=((),) * len(starts) if goals is None else goals,
        **fields,
    )
    return attrs.evolve(made, features=features_of(made) | features)


@pytest.fixture(scope="session")
def make() -> SimpleNamespace:
    """The functions of this file."""
    return SimpleNamespace(roadmap=roadmap, grid=grid, path=path, problem=problem)
