"""Edges from chosen moves are those of the whole order, and such as these imply."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.model.planning.occupations import occupations_of, resource_edges
from mrpbench_core.model.planning.type2_edges import moves_of, type2_edges
from mrpbench_core.testing.instances.random_plans import random_plan


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
    assert set(zip(*every.kept(chosen[every.before]), strict=True)) <= found
    for before, after, completed in found:
        implies = every.completed >= completed
        for ends, ours, comes_first in ((every.before, before, False), (every.after, after, True)):
            implies &= moves.robot[ends] == moves.robot[ours]
            implies &= (ends <= ours) if comes_first else (ends >= ours)
        assert implies.any()
