"""Validates a plan against its problem, without code of planners or dispatchers."""

import attrs

from mrpbench_core.checking.conflicts import Conflict, find_conflicts
from mrpbench_core.checking.paths import path_faults
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class PlanReport:
    """The faults of a plan."""

    faults: tuple[str, ...] = ()
    """Reasons why paths are not valid for this problem, one sentence each."""
    conflicts: tuple[Conflict, ...] = ()
    """Conflicts between robots; not searched for, so empty, if there are faults."""

    @property
    def valid(self) -> bool:
        """True if there are neither faults nor conflicts."""
        return not self.faults and not self.conflicts


_latest: list[tuple[Problem, Plan, PlanReport]] = []
"""The plan that was checked last: a plan of which the promises are judged is checked again where it is adopted."""


def check_plan(problem: Problem, plan: Plan, conflict_limit: int | None = None) -> PlanReport:
    """Check every path and, if none has a fault, every pair of robots.

    All rules of `mrpbench_core.model.planning.conflicts` are checked, resources included. A turn is a move between
    vertices at one place, so that headings need no rule of their own.

    Args:
        problem: what was planned.
        plan: what to check.
        conflict_limit: the number of conflicts to report, the earliest first; None = all, 0 = none are searched for.
    """
    known = (report for asked, made, report in _latest if asked is problem and made is plan)
    report = next(known, None) or _report(problem, plan, conflict_limit != 0)
    if conflict_limit != 0:
        _latest[:] = [(problem, plan, report)]
    return attrs.evolve(report, conflicts=report.conflicts[:conflict_limit])


def _report(problem: Problem, plan: Plan, searches: bool) -> PlanReport:
    if len(plan.paths) != len(problem):
        return PlanReport(faults=(f"{len(plan.paths)} paths for {len(problem)} robots",))
    faults = [f"robot {robot}: {fault}" for robot, fault in path_faults(problem, plan.paths).items()]
    if faults or not searches:
        return PlanReport(faults=tuple(faults))
    return PlanReport(conflicts=tuple(find_conflicts(problem, plan)))
