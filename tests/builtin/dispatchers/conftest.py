"""Roadmaps, problems and plans in a few words, for the tests of dispatchers."""

from types import SimpleNamespace

import attrs
import numpy as np
import pytest
from mrpbench_tests.instances.roadmaps import two_way, two_way_grid

from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem, features_of
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.testing.drawing import path_through


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
    plan = Plan(paths=tuple(path_through(roadmap, route) for route in routes))
    return problem(roadmap, plan, [route[0] for route in routes], **fields), plan


def view(reached, cleared=None, revision: int = 0) -> FleetView:
    """The view of a dispatcher of robots with this progress."""
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
    """Functions that build them."""
    return SimpleNamespace(
        roadmap=two_way, grid=two_way_grid, path=path_through, problem=problem, solved=solved, view=view
    )
