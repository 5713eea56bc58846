"""Strategies draw valid values, and values of every relevant kind."""

import numpy as np
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.problem import Feature, features_of
from mrpbench_core.testing import strategies

QUICK = settings(deadline=None, max_examples=40)


@QUICK
@given(strategies.problems(roadmap=strategies.roadmaps(), features=frozenset(Feature)))
def test_problems_are_consistent(drawn):
    assert features_of(drawn) <= drawn.features
    assert len(set(drawn.start.tolist())) == len(drawn)
    assert all(0 <= goal < len(drawn.roadmap.position) for goals in drawn.goals for goal in goals[0])


@QUICK
@given(strategies.plans())
def test_plans_have_no_conflicts(drawn):
    assert check_plan(*drawn).valid


@QUICK
@given(strategies.fleets(), strategies.scenarios())
def test_fleets_and_scenarios_are_whole(fleet, scenario):
    assert (fleet.radii > 0).all()
    assert len(scenario.tasks) == len(scenario.start)
    assert scenario.id == scenario.id


def test_all_features_are_drawn():
    search = settings(max_examples=2000, database=None, phases=[Phase.generate])  # any will do, not only the least
    walls = find(strategies.grids(), lambda grid: len(grid.position) < np.prod(grid.grid.shape), settings=search)
    assert len(walls.position)
    slow = find(strategies.roadmaps(), lambda roadmap: (roadmap.duration > 1).any(), settings=search)
    assert Feature.EDGE_DURATIONS in features_of(
        find(strategies.problems(st.just(slow)), lambda _: True, settings=search)
    )
    _, plan = find(
        strategies.plans(), lambda drawn: sum(path.arrival > 0 for path in drawn[1].paths) > 1, settings=search
    )
    assert len(plan.paths) >= 2
    features = frozenset({Feature.GOAL_SETS, Feature.GOAL_SEQUENCES, Feature.FOOTPRINTS, Feature.FOLLOWING_FORBIDDEN})
    find(strategies.problems(features=features), lambda drawn: drawn.features == features, settings=search)
