"""The judge of planners finds every false answer."""

import math
from itertools import count
from typing import ClassVar

import attrs
import pytest
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.oracles.judge import answer_faults, ask, changes, contradictions

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.planning.plan import AnytimePoint, Budget, Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.testing.faults import Fault

BUDGET = Budget(wall_s=1, memory_bytes=1 << 20)
ASKED = problem_on(grid_of(["...", "..."]), [0], [2])  # 0 1 2 above 3 4 5
SHORTEST = [(0, 1), (1, 2)]
ROUND = [(0, 3), (3, 4), (4, 5), (5, 2)]
ROUND_CURVE = (AnytimePoint(seconds=0.1, cost=2), AnytimePoint(seconds=0.2, cost=4))


@attrs.frozen(kw_only=True)
class Optimal(Planner):
    promises: ClassVar[frozenset[Promise]] = frozenset(Promise) - {Promise.BOUNDED}
    robustness: ClassVar[int] = 0

    answers: tuple[PlanResult, ...] = ()
    number: count = attrs.field(factory=count, eq=False, repr=False)

    def plan(self, problem, budget):
        return self.answers[next(self.number)]


@attrs.frozen(kw_only=True)
class Bounded(Optimal):
    promises: ClassVar[frozenset[Promise]] = frozenset(Promise) - {Promise.OPTIMAL, Promise.ROBUST}
    w: float = 1.5

    @property
    def suboptimality(self):
        return self.w


@attrs.frozen(kw_only=True)
class Careless(Optimal):
    promises: ClassVar[frozenset[Promise]] = frozenset()


@attrs.frozen(kw_only=True)
class Assigning(Careless):
    supports: ClassVar[frozenset[Feature]] = frozenset({Feature.GOAL_SETS})

    assign: bool = True


def path(steps, asked=ASKED) -> RobotPath:
    edges = [tuple(edge) for edge in asked.roadmap.edges.tolist()]
    ticks = range(len(steps) + 1)
    return RobotPath(edge=[edges.index(step) for step in steps], enter=ticks[:-1], leave=ticks[1:])


def answer(steps=SHORTEST, bound=2.0, **fields) -> PlanResult:
    plan = None if steps is None else Plan(paths=(path(steps),))
    fields.setdefault("status", PlanStatus.SOLVED if plan else PlanStatus.TIMEOUT)
    return PlanResult(plan=plan, lower_bound=bound, **fields)


@pytest.mark.parametrize("optimum", [2, None])
@pytest.mark.parametrize(
    ("planner", "result"),
    [
        (Optimal(), answer()),
        (Optimal(), answer(None, 1.0)),
        (Bounded(w=2.0), answer(ROUND)),
        (Careless(), answer(ROUND, math.nan)),
        (Careless(), answer(None, status=PlanStatus.GAVE_UP)),
    ],
)
def test_true_results_have_no_faults(planner, result, optimum):
    assert answer_faults(ASKED, planner, result, optimum) == []


@pytest.mark.parametrize(
    ("planner", "result", "optimum", "said"),
    [
        (Optimal(), answer(ROUND), 2, "exceeds 1 times its lower bound 2"),
        (Optimal(), answer(ROUND, math.nan), 2, "costs 4, the optimum is 2"),
        (Optimal(), answer(ROUND, 4.0), 2, "proves the lower bound 4, the optimum is 2"),
        (Optimal(), answer(), 3, "costs 2, the optimum is 3"),
        (Optimal(), answer(SHORTEST, 3.0), None, "cost 2 is below its lower bound 3"),
        (Optimal(), answer(SHORTEST[:1]), None, "instead of its goal"),
        (Optimal(), answer(None, 3.0), 2, "lower bound 3,"),
        (Optimal(), answer(None, status=PlanStatus.UNSOLVABLE), 2, "says unsolvable, the optimum is 2"),
        (Optimal(), answer(None, status=PlanStatus.GAVE_UP), None, "gave up"),
        (Optimal(), answer(None, status=PlanStatus.SOLVED), None, "returns no plan"),
        (Optimal(), answer(status=PlanStatus.GAVE_UP), None, "a plan with the status gave_up"),
        (Bounded(), answer(ROUND), None, "exceeds 1.5 times"),
        (Bounded(), answer(ROUND, math.nan), None, "proves no lower bound"),
        (Careless(), answer(SHORTEST[1:]), None, "starts at vertex 1"),
        (Careless(), answer(ROUND, history=ROUND_CURVE), None, "rise"),
    ],
)
def test_false_results_have_faults(planner, result, optimum, said):
    assert any(said in fault for fault in answer_faults(ASKED, planner, result, optimum))


def test_conflicts_are_faults_of_planners_that_promise_no_conflicts():
    asked = problem_on(grid_of(["..."]), [0, 2], [2, 0])
    crossing = Plan(paths=(path([(0, 1), (1, 2)], asked), path([(2, 1), (1, 0)], asked)))
    result = PlanResult(status=PlanStatus.SOLVED, plan=crossing, lower_bound=4)
    assert "vertex conflict" in answer_faults(asked, Optimal(), result)[0]
    assert answer_faults(asked, Careless(), result) == []


def test_contradicting_results_are_found():
    some, better = (Bounded(w=9.0), answer(ROUND)), (Optimal(), answer())
    assert contradictions([some, better]) == []
    (high,) = contradictions([(Bounded(), answer(None, 3.0)), better])
    assert "lower bound 3," in high
    (denied,) = contradictions([(Bounded(), answer(None, status=PlanStatus.UNSOLVABLE)), better])
    assert "says unsolvable, but Optimal" in denied
    assert contradictions([(Careless(), answer()), (Optimal(), answer(ROUND, 4.0))]) == []


@pytest.mark.parametrize(
    ("second", "changed"),
    [
        (answer(), False),
        (answer(ROUND), True),
        (answer(bound=1.0), True),
        (answer(statistics={"expansions": 2}), True),
        (answer(ROUND, clock_bound=True), False),
        (answer(None), False),
        (answer(None, status=PlanStatus.UNSOLVABLE), True),
    ],
)
def test_another_answer_to_the_same_question_is_found(second, changed):
    assert bool(changes(ASKED, Optimal(answers=(second,)), BUDGET, answer())) is changed
    assert changes(ASKED, Careless(answers=(second,)), BUDGET, answer()) == []


def test_a_planner_is_not_judged_by_problems_that_it_skips():
    asked = problem_on(grid_of(["..."]), [0], [2], horizon=5)
    with pytest.raises(Fault, match="skips, because it does not support horizon"):
        ask(Optimal(answers=(answer(),)), asked)


def test_a_task_belongs_to_one_robot_even_where_robots_disappear():
    asked = problem_on(grid_of(["..."]), [0, 1], [(1, 2), (1, 2)], at_goal="disappear")
    both = Plan(paths=(path([(0, 1), (1, 2)], asked), path([(1, 2)], asked)))
    result = PlanResult(status=PlanStatus.SOLVED, plan=both, lower_bound=3)
    assert answer_faults(asked, Careless(), result) == []
    (fault,) = answer_faults(asked, Assigning(), result)
    assert "robots 0 and 1 take the same goal, vertex 2" in fault
