"""LastDispatcher: release the segments of the plan tick by tick, for all robots together."""

import attrs
import numpy as np
from mrpbench_core.api import Dispatcher, DispatchError, DispatcherSession, option
from mrpbench_core.checking.facility_use import check_facility_use
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class LastDispatcher(Dispatcher):
    """Releases the segments that begin at one tick once all robots have finished the earlier ones.

    A late robot therefore delays all others. Robots that move at the same tick are not separated.
    """

    look_ahead: int = option(0, help="number of further ticks to release", validator=attrs.validators.ge(0))

    def start(self, problem: Problem, plan: Plan) -> DispatcherSession:
        """Begin to release a plan."""
        return LastDispatcherSession(self, problem, plan)


class LastDispatcherSession(DispatcherSession):
    """Releases one plan."""

    def __init__(self, options: LastDispatcher, problem: Problem, plan: Plan) -> None:
        self.options = options
        self.released = np.zeros(len(problem), np.int32)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with a new plan that begins with what was released, but for the first `cut` i4[n] segments.

        Raises:
            DispatchError: the plan uses a door or a lift, which this dispatcher does not request.
        """
        if uses := check_facility_use(problem, plan):
            raise DispatchError(f"{uses[0]}, and doors and lifts are not requested: use the dispatcher adg")
        if cut is not None:
            self.released = self.released - cut
        if problem.commitments:
            self.released = np.maximum(self.released, [len(path) for path in problem.commitments])
        self.enter = [path.enter for path in plan.paths]
        self.ticks = np.unique(np.concatenate([np.empty(0, np.int64), *self.enter]))

    def update(self, now: float, view: FleetView) -> Orders:  # noqa: ARG002 - order is all that counts, not time
        """Release up to the first tick with an unfinished segment, and `look_ahead` further ticks."""
        waiting = [path[done] for path, done in zip(self.enter, view.reached.tolist(), strict=True) if done < len(path)]
        first = int(np.searchsorted(self.ticks, min(waiting))) if waiting else len(self.ticks)
        last = min(first + self.options.look_ahead, len(self.ticks) - 1)
        if last >= 0:
            begun = [np.searchsorted(path, self.ticks[last], side="right") for path in self.enter]
            self.released = np.maximum(self.released, begun).astype(np.int32)
        return Orders(released=self.released)
