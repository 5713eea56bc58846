"""The judge of the soaks finds every lie."""

import math
from itertools import count
from typing import ClassVar

import attrs
import pytest
from mapf_claims import changes, contradictions, faults
from mapf_instances import grid, problem

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.model.plan import AnytimePoint, Budget, Path, Plan, PlanResult, PlanStatus

BUDGET = Budget(wall_s=1, memory_bytes=1 << 20)
ASKED = problem(grid(["...", "..."]), [0], [2])  # 0 1 2 above 3 4 5
SHORTEST = [(0, 1), (1, 2)]
ROUND = [(0, 3), (3, 4), (4, 5), (5, 2)]
ROUND_CURVE = (AnytimePoint(seconds=0.1, cost=2), AnytimePoint(seconds=0.2, cost=4))


@attrs.frozen(kw_only=True)
class Optimal(Planner):
    promises: ClassVar[frozenset[Promise]] = frozenset(Promise) - {Promise.BOUNDED}

    answers: tuple[PlanResult, ...] = ()
    number: count = attrs.field(factory=count, eq=False, repr=False)

    def plan(self, problem, budget):
        return self.answers[next(self.number)]


@attrs.frozen(kw_only=True)
class Bounded(Optimal):
    promises: ClassVar[frozenset[Promise]] = frozenset(Promise) - {Promise.OPTIMAL}

    w: float = 1.5


@attrs.frozen(kw_only=True)
class Careless(Optimal):
    promises: ClassVar[frozenset[Promise]] = frozenset()


def path(steps, asked=ASKED) -> Path:
    edges = [tuple(edge) for edge in asked.roadmap.edges.tolist()]
    ticks = range(len(steps) + 1)
    return Path(edge=[edges.index(step) for step in steps], enter=ticks[:-1], leave=ticks[1:])


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
def test_what_is_true_is_let_pass(planner, result, optimum):
    assert faults(ASKED, planner, result, optimum) == []


@pytest.mark.parametrize(
    ("planner", "result", "optimum", "said"),
    [
        (Optimal(), answer(ROUND), 2, "but optimal"),
        (Optimal(), answer(ROUND, math.nan), None, "but optimal"),
        (Optimal(), answer(ROUND, 4.0), 2, "lower bound 4.0, optimum 2"),
        (Optimal(), answer(), 3, "cost 2, optimum 3"),
        (Optimal(), answer(SHORTEST, 3.0), None, "cost 2, lower bound 3.0"),
        (Optimal(), answer(SHORTEST[:1]), None, "instead of its goal"),
        (Optimal(), answer(None, 3.0), 2, "lower bound 3.0"),
        (Optimal(), answer(None, status=PlanStatus.UNSOLVABLE), 2, "unsolvable, optimum 2"),
        (Optimal(), answer(None, status=PlanStatus.GAVE_UP), None, "gave up"),
        (Optimal(), answer(None, status=PlanStatus.SOLVED), None, "without plan"),
        (Optimal(), answer(status=PlanStatus.TIMEOUT), None, "timeout with a plan"),
        (Bounded(), answer(ROUND), None, "more than 1.5 times"),
        (Bounded(), answer(ROUND, math.nan), None, "more than 1.5 times"),
        (Careless(), answer(SHORTEST[1:]), None, "starts at vertex 1"),
        (Careless(), answer(ROUND, history=ROUND_CURVE), None, "rise"),
    ],
)
def test_lies_are_found(planner, result, optimum, said):
    assert any(said in fault for fault in faults(ASKED, planner, result, optimum))


def test_robots_in_one_anothers_way_are_found():
    asked = problem(grid(["..."]), [0, 2], [2, 0])
    crossing = Plan(paths=(path([(0, 1), (1, 2)], asked), path([(2, 1), (1, 0)], asked)))
    result = PlanResult(status=PlanStatus.SOLVED, plan=crossing, lower_bound=4)
    assert "Conflict" in faults(asked, Optimal(), result)[0]
    assert faults(asked, Careless(), result) == []


def test_answers_that_cannot_both_be_true_are_found():
    some, better = (Bounded(w=9.0), answer(ROUND)), (Optimal(), answer())
    assert contradictions([some, better]) == []
    (high,) = contradictions([(Bounded(), answer(None, 3.0)), better])
    assert "lower bound 3.0" in high
    (denied,) = contradictions([(Bounded(), answer(None, status=PlanStatus.UNSOLVABLE)), better])
    assert "unsolvable, but Optimal" in denied
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
