"""The dispatcher `all_at_once`: every path is sent whole, whatever the others do.

So did MRP-Bench (Schaefer et al., "A Benchmark for Multi-Robot Planning in Realistic, Complex and Cluttered
Environments", ICRA 2023), which let 2.5 s pass between one robot and the next. Nothing keeps robots apart
here but what they see themselves.
"""

import attrs
import numpy as np

from mrpbench_core.api import Dispatcher, DispatcherSession, option
from mrpbench_core.builtin.dispatchers.uses import refuse_facilities
from mrpbench_core.model.execution import FleetView, Orders
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem


@attrs.frozen(kw_only=True)
class AllAtOnce(Dispatcher):
    """Sends each robot its whole path at the start."""

    stagger: float = option(
        0.0, help="time from one robot's path to the next robot's", unit="s", validator=attrs.validators.ge(0)
    )

    def start(self, problem: Problem, plan: Plan) -> "AllAtOnceSession":
        """Begin to send; any plan is accepted, unless it leads through doors or lifts.

        Raises:
            DispatchError: it does; nobody would open them.
        """
        refuse_facilities(problem, plan, "all_at_once")
        return AllAtOnceSession(self.stagger, problem, plan)


class AllAtOnceSession(DispatcherSession):
    """Sends one plan, robot after robot."""

    def __init__(self, stagger: float, problem: Problem, plan: Plan) -> None:
        self.stagger = stagger
        self.begun: float | None = None
        self.released = np.zeros(len(plan.paths), np.int32)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan) -> None:
        """Send the new paths to the robots whose turn has come, and to the others when it does."""
        self.length = np.array([len(path) for path in plan.paths], np.int32)
        if problem.commitments:
            self.released = np.maximum(self.released, [len(path) for path in problem.commitments])

    def update(self, now: float, view: FleetView) -> Orders:  # noqa: ARG002 - it does not look
        """Release whole paths."""
        if self.begun is None:
            self.begun = now
        turn = self.begun + self.stagger * np.arange(len(self.length)) <= now + 1e-9
        self.released = np.where(turn, self.length, self.released)
        return Orders(released=self.released)
