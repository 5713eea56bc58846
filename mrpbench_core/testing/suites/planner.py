"""Checks that every planner must pass."""

import pickle
import time
from collections.abc import Iterator

from mrpbench_core.api.planner import Planner, Promise
from mrpbench_core.checking.assignment import check_choice
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.drive.plan import LATE_S, cpu_s
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_core.referee.plans import Promises
from mrpbench_core.testing.drawing import build, grid
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.named_problems import OPTIMA, choices, solvable, unsolvable
from mrpbench_core.testing.planner_call import call
from mrpbench_core.testing.suites.component import ComponentConformance

TRIES = 3
"""Calls of which the fastest counts, because machines are busy."""
SHORT = 1.0
"""Wall seconds for problems that some planners search until their time is over."""


class PlannerConformance(ComponentConformance):
    """Checks of planners: `class TestMine(PlannerConformance)`.

    The problems are those of `mrpbench_core.testing.named_problems` that the planner does not skip.
    """

    def make(self) -> Planner:
        """Return the planner to check."""
        raise NotImplementedError("define make(self) and return the planner to check")

    def test_declares_features_and_promises(self) -> None:
        planner = self.make()
        for name, kind in (("supports", Feature), ("promises", Promise)):
            declared = getattr(planner, name)
            right = isinstance(declared, frozenset) and all(isinstance(entry, kind) for entry in declared)
            require(
                right,
                f"{name} is {declared!r} instead of a frozenset of {kind.__name__}",
            )
        Promises.of(planner)

    def test_skips_features_that_it_does_not_support(self) -> None:
        planner = self.make()
        for name, problem in solvable().items():
            reason = planner.skip(problem)
            require(
                reason is None or reason,
                f"skip returns {reason!r} for {name}: return a reason or None",
            )
            lacking = sorted(problem.features - planner.supports)
            if lacking and reason is None:
                raise Fault(f"does not skip {name}, but does not support {', '.join(lacking)}")

    def test_has_a_problem_for_every_feature_it_supports(self) -> None:
        planner = self.make()
        taken = list(asked(planner))
        if not taken:
            raise Skip(f"it skips every problem here, the first because it {planner.skip(solvable()['a robot alone'])}")
        tried = frozenset().union(*(problem.features for _, problem in taken))
        idle = sorted(planner.supports - tried)
        require(not idle, f"supports {', '.join(idle)}, but skips every problem with it")

    def test_finds_the_way_of_a_robot_alone(self) -> None:
        planner = self.make()
        problem = solvable()["a robot alone"]
        if reason := planner.skip(problem):
            raise Skip(f"it {reason}")
        result = call(planner, problem)
        require(
            result.status is PlanStatus.SOLVED,
            f"returns {result.status} for a robot alone in a corridor; skip problems that it cannot solve (`skip`)",
        )

    def test_plans_are_valid(self) -> None:
        planner = self.make()
        promised = Promise.CONFLICT_FREE in planner.promises
        for name, problem in asked(planner):
            result = call(planner, problem)
            if result.plan is not None:
                report = check_plan(problem, result.plan)
                require(not report.faults, f"{name}: {'; '.join(report.faults)}")
                require(
                    not (promised and report.conflicts), f"{name}: {'; '.join(str(each) for each in report.conflicts)}"
                )

    def test_gives_every_robot_a_task_of_its_own(self) -> None:
        planner = self.make()
        if not planner.assigns:
            raise Skip("it leaves the tasks to an assigner")
        for name, problem in choices().items():
            if planner.skip(problem) is None and (plan := call(planner, problem).plan) is not None:
                require(not check_plan(problem, plan).faults, f"{name}: {'; '.join(check_plan(problem, plan).faults)}")
                require(not (faults := check_choice(problem, plan)), f"{name}: {'; '.join(faults)}")

    def test_does_not_claim_that_a_solvable_problem_is_unsolvable(self) -> None:
        planner = self.make()
        for name, problem in asked(planner):
            require(
                call(planner, problem).status is not PlanStatus.UNSOLVABLE,
                f"returns unsolvable for {name}, which has a plan: return it only when proved",
            )

    def test_says_so_when_there_is_no_plan(self) -> None:
        planner = self.make()
        for name, problem in unsolvable().items():
            if planner.skip(problem) is None:
                result = call(planner, problem, SHORT)
                if result.plan is not None:
                    report = check_plan(problem, result.plan)
                    broken = report.faults or (Promise.CONFLICT_FREE in planner.promises)
                    require(not broken, f"returns a plan for {name}, which has none")

    def test_keeps_its_deadline(self) -> None:
        planner = self.make()
        roadmap = grid(24, 24)
        robots = 60
        starts, goals = range(robots), [(len(roadmap.position) - 1 - robot,) for robot in range(robots)]
        crowd = build(roadmap, starts, goals)
        if reason := planner.skip(crowd):
            raise Skip(f"it {reason}")
        for wall_s in (0.2, 0.001):  # a configuration requires more than 0
            tries = [overrun(planner, crowd, wall_s) for _ in range(TRIES)]
            require(
                min(tries) <= LATE_S,
                f"returns {min(tries):.2f} s after its limit of {wall_s:g} s in the best of {TRIES} calls; runs drop"
                f" plans that come more than {LATE_S:g} s late: check `budget.wall_s` more often",
            )

    def test_does_not_change_the_problem(self) -> None:
        planner = self.make()
        for name, problem in asked(planner):
            before = pickle.loads(pickle.dumps(problem))  # noqa: S301 - our own
            call(planner, problem)
            require(problem == before, f"changes the problem {name}: copy arrays before writing to them")

    def test_gives_the_same_plan_again(self) -> None:
        planner = self.make()
        if Promise.DETERMINISTIC not in planner.promises:
            raise Skip("it does not promise to be deterministic")
        copy = pickle.loads(pickle.dumps(planner))  # noqa: S301 - our own
        for name, problem in asked(planner):
            first = answer(call(planner, problem))
            require(
                answer(call(planner, problem)) == first,
                f"plans {name} differently the second time: draw random numbers from `Budget.seed` only",
            )
            require(answer(call(copy, problem)) == first, f"a pickled copy plans {name} differently")

    def test_is_complete(self) -> None:
        planner = self.make()
        if Promise.COMPLETE not in planner.promises:
            raise Skip("it does not promise to be complete")
        for name, problem in asked(planner):
            status = call(planner, problem).status
            require(status is PlanStatus.SOLVED, f"returns {status} for {name}, which has a plan")

    def test_bounds_hold(self) -> None:
        planner = self.make()
        for name, problem, optimum in compared(planner):
            bound = call(planner, problem).lower_bound
            require(not bound > optimum, f"returns the lower bound {bound:g} for {name}, whose optimum is {optimum:g}")

    def test_is_optimal(self) -> None:
        planner = self.make()
        if Promise.OPTIMAL not in planner.promises:
            raise Skip("it does not promise to be optimal")
        for name, problem, optimum in compared(planner):
            plan = call(planner, problem).plan
            cost = None if plan is None else plan.sum_of_costs
            require(cost in (None, optimum), f"{name}: costs {cost}, the optimum is {optimum:g}")

    def test_is_within_its_bound(self) -> None:
        planner = self.make()
        if Promise.BOUNDED not in planner.kept_promises:
            raise Skip("it does not promise to be bounded")
        w = planner.suboptimality
        for name, problem, optimum in compared(planner):
            result = call(planner, problem)
            if result.plan is not None:
                cost, bound = result.plan.sum_of_costs, result.lower_bound
                require(cost <= w * bound + 1e-9, f"{name}: costs {cost}, more than {w:g} times its bound {bound:g}")
                require(
                    cost <= w * optimum + 1e-9, f"{name}: costs {cost}, more than {w:g} times the optimum {optimum:g}"
                )


def overrun(planner: Planner, problem: Problem, wall_s: float) -> float:
    """Seconds by which a planner exceeds its limit, in wall time and in CPU time: on a busy machine a call waits."""
    began, cpu = time.monotonic(), cpu_s()
    call(planner, problem, wall_s)
    return min(time.monotonic() - began, cpu_s() - cpu) - wall_s


def asked(planner: Planner) -> Iterator[tuple[str, Problem]]:
    """Problems with a plan that the planner does not skip, by name."""
    for name, problem in solvable().items():
        if planner.skip(problem) is None:
            yield name, problem


def compared(planner: Planner) -> Iterator[tuple[str, Problem, int]]:
    """Problems whose least sum of costs is known, by name, with it."""
    for name, problem in asked(planner):
        if name in OPTIMA:
            yield name, problem, OPTIMA[name]


def answer(result: PlanResult) -> tuple[object, ...]:
    """The parts of a result that must not differ from call to call; statistics may hold times."""
    return result.status, result.plan
