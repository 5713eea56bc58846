"""Edges from chosen moves are those of the whole order, and such as these imply."""

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan

from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.type2_edges import moves_of, type2_edges


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_edges_from_chosen_moves_are_those_of_all_moves(seed):
    random = np.random.default_rng(seed)
    problem, plan = random_plan(random)
    moves = moves_of(problem, plan)
    resources = resource_edges(problem, occupations_of(problem, moves))
    chosen = random.random(len(moves.robot)) < random.random()
    every = type2_edges(problem, moves, resources)
    found = set(zip(*type2_edges(problem, moves, resources, chosen), strict=True))
    assert all(chosen[before] for before, _, _ in found)
    assert set(zip(*every.subset(chosen[every.before]), strict=True)) <= found
    for before, after, completed in found:
        implies = every.completed >= completed
        for ends, ours, comes_first in ((every.before, before, False), (every.after, after, True)):
            implies &= moves.robot[ends] == moves.robot[ours]
            implies &= (ends <= ours) if comes_first else (ends >= ours)
        assert implies.any()


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(-50, -1))
def test_edges_do_not_depend_on_when_time_begins(seed, ticks):
    problem, plan = random_plan(np.random.default_rng(seed))
    earlier = attrs.evolve(problem, since=problem.begins + ticks), attrs.evolve(plan, paths=plan.paths.later(ticks))
    moves, shifted = moves_of(problem, plan), moves_of(*earlier)
    chosen = np.arange(len(moves.robot)) % 3 > 0
    for some in (None, chosen):
        resources = [resource_edges(it, occupations_of(it, at)) for it, at in ((problem, moves), (earlier[0], shifted))]
        found = type2_edges(problem, moves, resources[0], some), type2_edges(earlier[0], shifted, resources[1], some)
        assert all((one == other).all() for one, other in zip(*found, strict=True))
