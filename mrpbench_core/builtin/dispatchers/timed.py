"""The dispatcher `timed`: releases by the plan's times, whether or not robots keep them."""

import attrs
import numpy as np

from mrpbench_core.api import Dispatcher, DispatchError, DispatcherSession
from mrpbench_core.checking.facility_use import check_facility_use
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class Timed(Dispatcher):
    """Releases each segment at the time at which the plan enters it."""

    def start(self, problem: Problem, plan: Plan) -> "TimedSession":
        """Begin to release any plan that uses no doors or lifts; tick 0 of the plan is simulated time 0.

        Raises:
            DispatchError: the plan uses a door or a lift, which would not be opened.
        """
        return TimedSession(problem, plan)


class TimedSession(DispatcherSession):
    """Releases one plan by the clock."""

    def __init__(self, problem: Problem, plan: Plan) -> None:
        self.released = np.zeros(len(plan.paths), np.int32)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with the times of the new plan."""
        if uses := check_facility_use(problem, plan):
            raise DispatchError(f"{uses[0]}, and the dispatcher timed does not request doors or lifts: use adg")
        if cut is not None:
            self.released = self.released - cut
        if problem.commitments:
            self.released = np.maximum(self.released, problem.committed)
        paths = Paths.of(plan.paths)
        order = np.argsort(paths.enter, kind="stable")
        self.robot = paths.robot[order]
        self.due = paths.enter[order] * problem.roadmap.tick
        self.passed = 0
        self.by_clock = np.zeros(len(plan.paths), np.int32)

    def update(self, now: float, view: FleetView) -> Orders:  # noqa: ARG002 - progress does not matter
        """Release the segments that are due; times never decrease along a path, so these are leading segments."""
        passed = int(np.searchsorted(self.due, now + 1e-9, side="right"))
        self.by_clock += np.bincount(self.robot[self.passed : passed], minlength=len(self.by_clock)).astype(np.int32)
        self.passed = max(passed, self.passed)
        self.released = np.maximum(self.released, self.by_clock)
        return Orders(released=self.released)
