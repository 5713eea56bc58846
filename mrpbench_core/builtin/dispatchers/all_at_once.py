"""The dispatcher `all_at_once`: releases every path as a whole, independently of other robots.

MRP-Bench does the same (Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered
Environments", ICRA 2023), with 2.5 s between one robot and the next. Only their sensors keep robots apart.
"""

import attrs
import numpy as np

from mrpbench_core.api import Dispatcher, DispatchError, DispatcherSession, option
from mrpbench_core.checking.facility_use import check_facility_use
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class AllAtOnce(Dispatcher):
    """Sends each robot its whole path at the start."""

    stagger: float = option(
        0.0, help="time from one robot's path to the next robot's", unit="s", validator=attrs.validators.ge(0)
    )

    def start(self, problem: Problem, plan: Plan) -> "AllAtOnceSession":
        """Begin to release any plan that uses no doors or lifts.

        Raises:
            DispatchError: the plan uses a door or a lift, which would not be opened.
        """
        return AllAtOnceSession(self.stagger, problem, plan)


class AllAtOnceSession(DispatcherSession):
    """Sends one plan, robot after robot."""

    def __init__(self, stagger: float, problem: Problem, plan: Plan) -> None:
        self.stagger = stagger
        self.begun: float | None = None
        self.released = np.zeros(len(plan.paths), np.int32)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with the new paths."""
        if uses := check_facility_use(problem, plan):
            raise DispatchError(f"{uses[0]}, and the dispatcher all_at_once does not request doors or lifts: use adg")
        self.length = Paths.of(plan.paths).size.astype(np.int32)
        if cut is not None:
            self.released = self.released - cut
        if problem.commitments:
            self.released = np.maximum(self.released, problem.committed)

    def update(self, now: float, view: FleetView) -> Orders:  # noqa: ARG002 - progress does not matter
        """Release the whole paths of the robots that may start now."""
        if self.begun is None:
            self.begun = now
        turn = self.begun + self.stagger * np.arange(len(self.length)) <= now + 1e-9
        self.released = np.where(turn, self.length, self.released)
        return Orders(released=self.released)
