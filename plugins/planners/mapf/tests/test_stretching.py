"""p-robust plans: executed blindly with drawn stops, they have no conflict at least as often as the bound says."""

import math

import attrs
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_planners_mapf.stretching import Stops, stretch
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources
from mrpbench_tests.instances.roadmaps import two_way_grid

from mrpbench_core.checking.conflicts import find_conflicts
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget, Plan, PlanStatus
from mrpbench_core.referee.plans import Promises
from mrpbench_core.testing.drawing import build, problem

CROSSING = ". a .\n b . B\n . A ."
BUDGET = Budget(wall_s=1, memory_bytes=2**30, iterations=20)


def delay_until(random, stops, ticks):
    """The delays i8[ticks+1] of one robot until it has made each number of ticks, drawn tick by tick."""
    late, found = 0, [0]
    for _ in range(ticks):
        while random.random() < stops.p_delay:
            late += int(random.integers(stops.min_delay, stops.max_delay + 1))
        found.append(late)
    return np.array(found)


def blind(random, plan, stops):
    """The plan as robots execute it that look at nobody."""
    paths = []
    for path in plan.paths:
        late = delay_until(random, stops, int(path.leave[-1]) + 1 if len(path) else 0)
        # A robot that stops before a move waits where it is; it may also stop during a move.
        paths.append(attrs.evolve(path, enter=path.enter + late[path.enter + 1], leave=path.leave + late[path.leave]))
    return Plan(paths=tuple(paths))


@pytest.mark.parametrize(("p_delay", "most"), [(0.1, 1), (0.03, 6)])
def test_delays_are_distributed_as_drawn_tick_by_tick(p_delay, most):
    stops, random = Stops(p_delay, 1 + most // 3, most), np.random.default_rng(0)
    drawn = np.array([delay_until(random, stops, 30)[[1, 10, 30]] for _ in range(4000)])
    later = stops.later_than(np.array([1, 10, 30]), 25)
    for column, row in zip(drawn.T, later, strict=True):
        for delay in (0, 1, 3, 8):
            assert (column > delay).mean() == pytest.approx(row[delay], abs=0.03)
    assert later[2, 0] == pytest.approx(1 - (1 - p_delay) ** 30)


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 2**32 - 1), st.booleans(), st.sampled_from([0.5, 0.9]), st.sampled_from([(0.02, 1), (0.01, 4)]))
@example(0, False, 0.9, (0.02, 1))
def test_late_robots_meet_no_more_often_than_the_bound_says(seed, resources, p, delays):
    random = np.random.default_rng(seed)
    asked, plan = (random_plan_with_resources if resources else random_plan)(random)
    stops = Stops(delays[0], 1, delays[1])
    robust, bound = stretch(asked, plan, stops, p)
    assume(robust is not None)
    assert bound >= p
    assert check_plan(asked, robust).valid
    moves = [[path.edge[path.edge >= 0].tolist() for path in it.paths] for it in (plan, robust)]
    assert moves[0] == moves[1]
    runs = 150
    without = sum(not find_conflicts(asked, blind(random, robust, stops), 1) for _ in range(runs))
    assert without / runs >= bound - 4 * math.sqrt(bound * (1 - bound) / runs) - 2 / runs


@pytest.mark.parametrize("planner", [Cbs, Prioritized])
def test_planners_add_as_many_waits_as_p_needs(planner):
    asked = problem(CROSSING)
    costs = []
    for p in (0.0, 0.5, 0.85, 0.98, 0.9998):
        result = planner(p=p, p_delay=0.1).plan(asked, BUDGET)
        assert result.status is PlanStatus.SOLVED
        assert not p or result.statistics["p_robust"] >= p
        costs.append(result.plan.sum_of_costs)
    # The first robot needs two ticks until it leaves the middle: P(late by more than 0, 1, ...) = 0.19, 0.028, ...
    assert costs == [5, 5, 6, 7, 9]
    assert math.isnan(result.lower_bound)
    assert not Promises.of(planner(p=0.5)).made & {"optimal", "bounded", "complete"}


def test_waits_do_not_help_robots_that_rotate():
    ring = (0, 1, 3, 2)
    asked = build(two_way_grid(2, 2), ring, [()] * 4)
    asked = attrs.evolve(asked, goals=tuple(((goal,),) for goal in (1, 3, 2, 0)), radius=np.full(4, 0.2))
    assert Cbs().plan(asked, BUDGET).plan.sum_of_costs == 4
    result = Cbs(p=0.9, p_delay=0.3).plan(asked, BUDGET)
    assert result.status is PlanStatus.GAVE_UP
    assert result.plan is None
