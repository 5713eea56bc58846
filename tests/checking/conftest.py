"""Small roadmaps, problems and plans for the tests of validators."""

from types import SimpleNamespace

import attrs
import numpy as np
import pytest
from mrpbench_tests.instances.roadmaps import roadmap, two_way_grid

from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.planning.problem import Problem, features_of
from mrpbench_core.model.planning.roadmap import Roadmap


def two_way(points, pairs, ticks=1, level=0) -> Roadmap:
    """Two-way lanes `pairs` between `points`; all of `ticks`, or each edge of its own."""
    return roadmap(points, [edge for a, b in pairs for edge in ((a, b), (b, a))], ticks, level=level)


def grid(rows: int, columns: int, ticks=1) -> Roadmap:
    """A four-connected unit grid; vertex = row * columns + column."""
    made = two_way_grid(rows, columns)
    return attrs.evolve(made, duration=np.broadcast_to(ticks, made.duration.shape))


def path(roadmap: Roadmap, *steps) -> RobotPath:
    """A path of steps (from, to, leave tick), the first from tick 0; a step from a vertex to itself is a wait."""
    edges = {(int(a), int(b)): edge for edge, (a, b) in enumerate(roadmap.edges)}
    leave = [tick for _, _, tick in steps]
    return RobotPath(edge=[edges.get((a, b), -1) for a, b, _ in steps], enter=[0, *leave][: len(leave)], leave=leave)


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
    """Return functions that build them."""
    return SimpleNamespace(roadmap=two_way, grid=grid, path=path, problem=problem)
