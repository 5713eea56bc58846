"""k-robust plans: free of conflicts whoever is late where, and optimal as brute force finds them."""

import itertools
import math

import attrs
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lns import Lns
from mrpbench_planners_mapf.pbs import Pbs
from mrpbench_planners_mapf.prioritized import Prioritized
from mrpbench_tests.oracles.judge import ask
from mrpbench_tests.oracles.optimum import least_sum_of_costs

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.conflicts import exclusions
from mrpbench_core.model.planning.plan import Budget, Plan, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import problem
from mrpbench_core.testing.strategies import grids, problems, roadmaps

BUDGET = Budget(wall_s=1, memory_bytes=2**30, iterations=20)
PLANNERS = (Cbs, Ecbs, Eecbs, Pbs, Prioritized, Lns)
PLACES = grids(3, 4) | roadmaps(3, 4)
DRAWN = problems(PLACES, most_robots=3, features=frozenset({Feature.FOOTPRINTS, Feature.FOLLOWING_FORBIDDEN}))


def conflicts_if_late(asked: Problem, plan: Plan, k: int) -> bool:
    """Whether some pair of robots conflicts when each is 0 to k ticks late from some segment of its path on."""
    variants = [list(late_paths(path, k)) for path in plan.paths]
    for one, other in itertools.combinations(range(len(asked)), 2):
        for late, late_too in itertools.product(variants[one], variants[other]):
            paths = [*plan.paths]
            paths[one], paths[other] = late, late_too
            if not check_plan(asked, Plan(paths=tuple(paths))).valid:
                return True
    return False


def late_paths(path: RobotPath, k: int):
    yield path
    for segment, ticks in itertools.product(range(len(path)), range(1, k + 1)):
        enter, leave = path.enter.copy(), path.leave.copy()
        enter[segment + 1 :] += ticks
        leave[segment:] += ticks
        yield attrs.evolve(path, enter=enter, leave=leave)
    for ticks in range(1, k + 1):  # late already at the start
        wait = RobotPath(edge=[-1], enter=[0], leave=[ticks])
        yield RobotPath(
            edge=np.concatenate([wait.edge, path.edge]),
            enter=np.concatenate([wait.enter, path.enter + ticks]),
            leave=np.concatenate([wait.leave, path.leave + ticks]),
        )


def by_resources(asked: Problem, k: int) -> Problem:
    """The same problem, if following is allowed: each two elements that exclude one another do so k ticks longer.

    Rules 2 and 3 follow from rule 1 at the ends of the edge.
    """
    vertices = len(asked.roadmap.position)
    groups = [(vertex,) for vertex in range(vertices)]
    if Feature.FOOTPRINTS in asked.features:
        near = exclusions(asked.roadmap, 2 * float(asked.radius[0]))
        for element in range(len(near.first) - 1):
            groups += [(element, int(other)) for other in near.element[near.first[element] : near.first[element + 1]]]
    resources = tuple(
        Resource(
            name=f"{group}",
            kind="mutex",
            vertices=np.unique([it for it in group if it < vertices]),
            edges=np.unique([it - vertices for it in group if it >= vertices]),
            capacity=1,
            setup_ticks=k,
        )
        for group in sorted({tuple(sorted(set(group))) for group in groups})
    )
    return attrs.evolve(asked, roadmap=attrs.evolve(asked.roadmap, resources=resources))


@settings(max_examples=40)
@given(DRAWN, st.sampled_from(PLANNERS), st.integers(1, 2))
def test_nobody_meets_whoever_is_late(asked, planner, k):
    robust = planner(k=k)
    assume(robust.skip(asked) is None)
    result = ask(robust, asked, budget=BUDGET)
    if result.plan is not None:
        assert not conflicts_if_late(asked, result.plan, k)


@settings(max_examples=30)
@given(DRAWN, st.integers(1, 2))
def test_the_validator_finds_out_who_meets_if_late(asked, k):
    result = Prioritized().plan(asked, BUDGET)
    assume(result.plan is not None)
    robust = attrs.evolve(asked, rules=attrs.evolve(asked.rules, k=k))
    assert check_plan(robust, result.plan).valid != conflicts_if_late(asked, result.plan, k)


@settings(max_examples=40)
@given(problems(PLACES, most_robots=2, features=frozenset({Feature.FOOTPRINTS})), st.integers(0, 2))
def test_cbs_finds_the_optimum_of_brute_force(asked, k):
    optimum = least_sum_of_costs(by_resources(asked, k), most_states=3000)
    assume(optimum is not None and optimum < math.inf)
    assert ask(Cbs(k=k), asked, optimum, budget=BUDGET).plan is not None


def test_options_without_effect_are_named():
    assert Lns(k=2, p=0.5, initial="lacam").idle_options() == {"initial": "k is 2"}
    assert Cbs(k=1, p=0.5).idle_options() == {"rectangle": "k is 1"}
    assert Cbs().idle_options() == dict.fromkeys(("p_delay", "min_delay", "max_delay"), "p is 0")


@pytest.mark.parametrize("planner", PLANNERS)
@pytest.mark.parametrize("k", [0, 1, 3])
def test_the_second_of_a_crossing_comes_k_ticks_later(planner, k):
    asked = problem(". a .\n b . B\n . A .")
    result = planner(k=k).plan(asked, BUDGET)
    assert result.status is PlanStatus.SOLVED
    assert result.plan.sum_of_costs == 4 + 1 + k
