"""What the record keeps of a planner's claims."""

import attrs
import numpy as np
import pytest

from mrpbench_core.api.planner import Promise
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Rules
from mrpbench_core.referee.plan_summary import fingerprint, plan_summary
from mrpbench_core.referee.plans import Promises

OPTIMAL = Promises(made=frozenset({Promise.OPTIMAL, Promise.CONFLICT_FREE}), factor=1.0, assigns=False)
NOTHING = Promises(made=frozenset(), factor=1.0, assigns=False)


def test_a_valid_plan_has_its_cost_and_what_it_promises(run_context):
    found = plan_summary(OPTIMAL, run_context.problem, run_context.result)
    assert (found["cost"], found["lower_bound"], found["factor"], found["unsolvable"]) == (3, 3.0, 1.0, False)
    assert plan_summary(NOTHING, run_context.problem, run_context.result)["factor"] is None


def test_a_plan_with_conflicts_is_no_evidence(run_context):
    result = attrs.evolve(run_context.result, statistics={"conflicts": 1.0})
    assert plan_summary(NOTHING, run_context.problem, result)["cost"] is None


def test_a_plan_that_the_clock_decided_promises_no_cost(run_context):
    result = attrs.evolve(run_context.result, clock_bound=True)
    assert plan_summary(OPTIMAL, run_context.problem, result)["factor"] is None


def test_a_proof_that_no_plan_exists_is_a_claim(run_context):
    found = plan_summary(OPTIMAL, run_context.problem, PlanResult(status=PlanStatus.UNSOLVABLE))
    assert found["unsolvable"]
    assert found["cost"] is found["lower_bound"] is found["factor"] is None


@pytest.mark.parametrize(
    "change",
    [
        {"start": [1, 0]},
        {"goals": (((2,),), ((1,),))},
        {"goals": (((1, 2),), ((2,),))},
        {"radius": [0.15, 0.16]},
        {"rules": Rules(following="forbidden")},
        {"features": frozenset({Feature.FOOTPRINTS})},
    ],
)
def test_each_part_of_a_problem_changes_its_fingerprint(run_context, change):
    problem = run_context.problem
    assert fingerprint(attrs.evolve(problem)) == fingerprint(problem) != fingerprint(attrs.evolve(problem, **change))


def test_claims_about_robust_plans_are_about_a_problem_of_their_own(run_context):
    robust = attrs.evolve(OPTIMAL, k=1)
    one, other = (plan_summary(promises, run_context.problem, run_context.result) for promises in (OPTIMAL, robust))
    assert one["problem"] != other["problem"]
    assert one["setting"] != other["setting"]


def test_the_roadmap_changes_the_fingerprint_and_its_notes_do_not(run_context):
    roadmap = run_context.problem.roadmap
    slower = attrs.evolve(roadmap, duration=2 * np.asarray(roadmap.duration))
    assert fingerprint(roadmap) != fingerprint(slower)
    assert fingerprint(roadmap) == fingerprint(attrs.evolve(roadmap, notes=("a lane is blocked",)))


def test_goals_that_only_an_assigning_planner_has_do_not_change_the_setting(run_context):
    chosen = attrs.evolve(run_context.problem, goals=(((1, 2),), ((1, 2),)), features=frozenset({Feature.GOAL_SETS}))
    one, other = (plan_summary(OPTIMAL, problem, run_context.result) for problem in (run_context.problem, chosen))
    assert one["setting"] == other["setting"]
    assert one["problem"] != other["problem"]
