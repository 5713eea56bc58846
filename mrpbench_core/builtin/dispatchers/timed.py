"""The dispatcher `timed`: every robot keeps the plan's clock, and nobody checks whether it can."""

import attrs
import numpy as np

from mrpbench_core.api import Dispatcher, DispatcherSession
from mrpbench_core.builtin.dispatchers.uses import refuse_facilities
from mrpbench_core.model.execution import FleetView, Orders
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem


@attrs.frozen(kw_only=True)
class Timed(Dispatcher):
    """Releases each segment at the time at which the plan enters it."""

    def start(self, problem: Problem, plan: Plan) -> "TimedSession":
        """Begin at simulated time 0, the plan's tick 0; any plan is accepted, unless it leads through doors or lifts.

        Raises:
            DispatchError: it does; nobody would open them.
        """
        refuse_facilities(problem, plan, "timed")
        return TimedSession(problem, plan)


class TimedSession(DispatcherSession):
    """Releases one plan by the clock."""

    def __init__(self, problem: Problem, plan: Plan) -> None:
        self.released = np.zeros(len(plan.paths), np.int32)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan) -> None:
        """Go on by the new plan's times."""
        if problem.commitments:
            self.released = np.maximum(self.released, [len(path) for path in problem.commitments])
        robot = np.repeat(np.arange(len(plan.paths)), [len(path) for path in plan.paths])
        enter = np.concatenate([np.empty(0, np.int64), *(path.enter for path in plan.paths)])
        order = np.argsort(enter, kind="stable")
        self.robot = robot[order]
        self.due = enter[order] * problem.roadmap.tick
        self.passed = 0
        self.by_clock = np.zeros(len(plan.paths), np.int32)

    def update(self, now: float, view: FleetView) -> Orders:  # noqa: ARG002 - it does not look
        """Release what is due: within a path, times never decrease, so a count is a prefix."""
        passed = int(np.searchsorted(self.due, now + 1e-9, side="right"))
        self.by_clock += np.bincount(self.robot[self.passed : passed], minlength=len(self.by_clock)).astype(np.int32)
        self.passed = max(passed, self.passed)
        self.released = np.maximum(self.released, self.by_clock)
        return Orders(released=self.released)
