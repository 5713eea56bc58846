"""A planner is held to what it promises, and only to that."""

import subprocess
import sys
import time
from typing import ClassVar

import attrs
import pytest

from mrpbench_core.api import Planner, Promise
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.drive.plan import budget_of, call_planner
from mrpbench_core.model.planning.plan import AnytimePoint, Budget, Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.referee.plans import Promises, judge_plan

BUDGET = Budget(wall_s=1.0, memory_bytes=1 << 30)
COLLIDING = Plan(paths=(RobotPath(edge=[0], enter=[0], leave=[1]), RobotPath(edge=[-1, 2], enter=[0, 2], leave=[2, 3])))


@attrs.frozen(kw_only=True)
class Fixed(Planner):
    """Returns what it is given."""

    result: PlanResult
    promises: ClassVar[frozenset[Promise]] = frozenset()

    def plan(self, problem, budget):
        return self.result


class Careful(Fixed):
    promises = frozenset({Promise.CONFLICT_FREE})


class Optimal(Fixed):
    promises = frozenset({Promise.CONFLICT_FREE, Promise.OPTIMAL})


class Bounded(Fixed):
    promises = frozenset({Promise.CONFLICT_FREE, Promise.BOUNDED})
    suboptimality = 1.5


class Robust(Careful):
    promises = frozenset({Promise.CONFLICT_FREE, Promise.ROBUST})
    robustness = 3


class Assigning(Fixed):
    supports = frozenset({Feature.GOAL_SETS})
    assign = True


def seed_of_run(**changes) -> int:
    (point,) = load_study(
        {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "example", **changes}, ()
    ).runs
    return budget_of(point.config).seed


def test_planners_get_a_seed_that_only_the_runs_seed_and_repeat_decide():
    first = seed_of_run(seed=3)
    assert 0 <= first < 2**31
    assert seed_of_run(seed=3, planner="astar", limits={"planning": 5}) == first
    assert len({first, seed_of_run(seed=4), seed_of_run(seed=3, repeat=1)}) == 3


def judged(planner_class, problem, result):
    planner = planner_class(result=result)
    return judge_plan(Promises.of(planner), problem, call_planner(planner, problem, BUDGET)[0])


def test_conflicts_are_counted_for_a_planner_that_promises_nothing(run_context):
    result, fault = judged(Fixed, run_context.problem, PlanResult(status=PlanStatus.SOLVED, plan=COLLIDING))
    assert fault is None
    assert result.statistics["conflicts"] == 1


def test_conflicts_are_searched_for_without_a_count_only_where_they_break_a_promise(run_context):
    result = PlanResult(status=PlanStatus.SOLVED, plan=COLLIDING)
    free = judge_plan(Promises.of(Fixed(result=result)), run_context.problem, result, counts=False)
    assert free == (result, None)
    assert judge_plan(Promises.of(Careful(result=result)), run_context.problem, result, counts=False)[1] is not None


def test_conflicts_break_the_promise_of_a_planner_that_makes_it(run_context):
    _, fault = judged(Careful, run_context.problem, PlanResult(status=PlanStatus.SOLVED, plan=COLLIDING))
    assert fault is not None
    assert "vertex conflict of robots 0 and 1" in fault


def test_a_plan_must_leave_the_robots_as_far_apart_as_its_planner_promises(run_context):
    assert judged(Careful, run_context.problem, run_context.result)[1] is None
    _, fault = judged(Robust, run_context.problem, run_context.result)
    assert fault is not None
    assert "conflict of robots 0 and 1" in fault


def test_an_unsound_path_is_a_fault_of_every_planner(run_context):
    jump = Plan(paths=(RobotPath(edge=[2], enter=[0], leave=[1]), COLLIDING.paths[1]))
    _, fault = judged(Fixed, run_context.problem, PlanResult(status=PlanStatus.SOLVED, plan=jump))
    assert fault == "robot 0: starts at vertex 1 instead of 0"


def test_a_planner_that_assigns_must_give_every_robot_another_task(run_context):
    either = attrs.evolve(run_context.problem, goals=(((1, 2),),) * 2)
    together = Plan(paths=(RobotPath(edge=[0], enter=[0], leave=[1]), RobotPath(edge=[], enter=[], leave=[])))
    said = PlanResult(status=PlanStatus.SOLVED, plan=together)
    assert judged(Fixed, either, said)[1] is None
    assert judged(Assigning, either, said)[1] == (
        "robots 0 and 1 take the same goal, vertex 1, so that a task is left undone"
    )
    assert judged(Assigning, either, run_context.result)[1] is None


@pytest.mark.parametrize(
    ("planner", "bound", "holds"),
    [(Optimal, 3.0, True), (Optimal, 2.0, False), (Bounded, 2.0, True), (Bounded, 1.5, False), (Careful, 4.0, False)],
)
def test_costs_are_compared_with_the_lower_bound(run_context, planner, bound, holds):
    result = attrs.evolve(run_context.result, lower_bound=bound)
    _, fault = judged(planner, run_context.problem, result)
    assert (fault is None) is holds


def test_solved_without_a_plan_is_a_fault(run_context):
    _, fault = judged(Careful, run_context.problem, PlanResult(status=PlanStatus.SOLVED))
    assert fault == "has the status solved but returns no plan"


def test_a_plan_at_the_deadline_is_a_success_that_depends_on_the_clock(run_context):
    late = attrs.evolve(run_context.result, status=PlanStatus.TIMEOUT, lower_bound=2.0)
    result, fault = judged(Optimal, run_context.problem, late)
    assert fault is None
    assert result.status is PlanStatus.SOLVED
    assert result.clock_bound
    _, timing = call_planner(Optimal(result=late), run_context.problem, BUDGET)
    assert timing["clock_bound"] is True


def test_the_anytime_curve_is_part_of_the_timing(run_context):
    curve = (AnytimePoint(seconds=0.5, cost=float("inf"), lower_bound=2.0), AnytimePoint(seconds=1.5, cost=4.0))
    _, timing = call_planner(Fixed(result=attrs.evolve(run_context.result, history=curve)), run_context.problem, BUDGET)
    assert timing["planning_history"] == [[0.5, None, 2.0], [1.5, 4.0, None]]
    _, timing = call_planner(Fixed(result=run_context.result), run_context.problem, BUDGET)
    assert "planning_history" not in timing


def test_timing_is_that_of_the_call(run_context):
    _, timing = call_planner(Careful(result=run_context.result), run_context.problem, BUDGET)
    assert timing["planning_s"] < 1
    assert timing["planning_peak_bytes"] >= 0


def test_time_that_a_planner_spends_before_it_plans_counts(run_context):
    @attrs.frozen(kw_only=True)
    class Early(Fixed):
        def skip(self, problem):
            time.sleep(BUDGET.wall_s + 0.2)

    result, timing = call_planner(Early(result=run_context.result), run_context.problem, BUDGET)
    assert timing["planning_s"] > BUDGET.wall_s
    assert (result.status, result.plan) == (PlanStatus.TIMEOUT, None)


def test_cpu_time_counts_the_programs_that_a_planner_runs(run_context):
    @attrs.frozen(kw_only=True)
    class Delegating(Fixed):
        def plan(self, problem, budget):
            subprocess.run([sys.executable, "-c", "sum(range(3_000_000))"], check=True)
            return super().plan(problem, budget)

    _, timing = call_planner(Delegating(result=run_context.result), run_context.problem, BUDGET)
    assert timing["planning_cpu_s"] > 0.01


def test_an_invalid_result_is_a_fault_and_hooks_still_receive_a_result(run_context):
    result, fault = judged(Fixed, run_context.problem, None)
    assert fault == "returned None instead of a PlanResult"
    assert result.plan is None
