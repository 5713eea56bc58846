"""Roadmaps, problems and plans in a few words, for the tests of dispatchers."""

import sys
from itertools import pairwise
from pathlib import Path as File
from types import SimpleNamespace

import attrs
import numpy as np
import pytest

from mrpbench_core.model.execution import FleetView
from mrpbench_core.model.plan import Path, Plan
from mrpbench_core.model.problem import Problem, features_of
from mrpbench_core.model.roadmap import Roadmap

sys.path.insert(0, str(File(__file__).parent))


def roadmap(points, pairs, duration=None, tick=1.0) -> Roadmap:
    """Two-way lanes `pairs` between `points`; `duration` of each lane, 1 by default."""
    edges = [edge for a, b in pairs for edge in ((a, b), (b, a))]
    lasts = [1] * len(edges) if duration is None else np.repeat(duration, 2)
    return Roadmap(
        position=points,
        level=np.zeros(len(points)),
        heading=np.full(len(points), np.nan),
        edges=edges,
        duration=[lasts],
        tick=tick,
    )


def grid(rows: int, columns: int, size: float = 1.0, blocked=()) -> Roadmap:
    """A four-connected grid whose vertex is row * columns + column; lanes at `blocked` vertices are left out."""
    points = [(column * size, row * size) for row in range(rows) for column in range(columns)]
    pairs = [(v, v + 1) for v in range(rows * columns) if (v + 1) % columns]
    pairs += [(v, v + columns) for v in range((rows - 1) * columns)]
    return roadmap(points, [pair for pair in pairs if not set(pair) & set(blocked)])


def path(roadmap: Roadmap, vertices) -> Path:
    """One tick a step through `vertices`; a repeated vertex is a wait."""
    index = {(int(a), int(b)): edge for edge, (a, b) in enumerate(roadmap.edges)}
    steps = [index[a, b] if a != b else -1 for a, b in pairwise(vertices)]
    return Path(edge=steps, enter=np.arange(len(steps)), leave=np.arange(len(steps)) + 1)


def problem(roadmap: Roadmap, plan: Plan, starts, radius: float = 0.1, features=frozenset(), **fields) -> Problem:
    """The problem that `plan` solves: each robot's goal is where its path ends."""
    ends = [int(path.vertices(roadmap, start)[-1]) for path, start in zip(plan.paths, starts, strict=True)]
    made = Problem(
        roadmap=roadmap,
        profile=np.zeros(len(starts)),
        radius=np.full(len(starts), radius),
        start=starts,
        ready=np.zeros(len(starts)),
        goals=tuple(((end,),) for end in ends),
        **fields,
    )
    return attrs.evolve(made, features=features_of(made) | features)


def solved(roadmap: Roadmap, routes, **fields) -> tuple[Problem, Plan]:
    """A plan of paths through `routes` and the problem it solves."""
    plan = Plan(paths=tuple(path(roadmap, route) for route in routes))
    return problem(roadmap, plan, [route[0] for route in routes], **fields), plan


def view(reached, cleared=None, revision: int = 0) -> FleetView:
    """What a dispatcher sees of robots that got this far."""
    robots = len(reached)
    return FleetView(
        revision=revision,
        reached=reached,
        cleared=reached if cleared is None else cleared,
        pose=np.zeros((robots, 3)),
        level=np.zeros(robots),
        mode=np.zeros(robots),
    )


@pytest.fixture(scope="session")
def make() -> SimpleNamespace:
    """The functions of this file."""
    return SimpleNamespace(roadmap=roadmap, grid=grid, path=path, problem=problem, solved=solved, view=view)
