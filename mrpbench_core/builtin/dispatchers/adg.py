"""The dispatcher `adg`: an action dependency graph keeps the plan's order and forgets its times.

Hönig, Kiesel, Tinka, Durham and Ayanian, "Persistent and Robust Execution of MAPF Schedules in Warehouses", RA-L 2019.
A robot may begin its next move as soon as the robots that the plan lets pass first have passed, however late they are.
Delays therefore cause neither collisions nor deadlocks.
"""

import attrs

from mrpbench_core.dispatching.fixed_order import FixedOrder
from mrpbench_core.dispatching.order_keeping import OrderKeepingDispatcher, OrderKeepingSession
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem


@attrs.frozen(kw_only=True)
class Adg(OrderKeepingDispatcher):
    """Releases each move once the moves that precede it in the plan are out of its way."""

    def start(self, problem: Problem, plan: Plan) -> "AdgSession":
        """Begin to release a plan.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        return AdgSession(self, problem, plan)


class AdgSession(OrderKeepingSession):
    """Releases one plan after another, each in its own order."""

    def copied(self) -> "AdgSession":
        """Return a session that goes on from here by itself."""
        return self._copied()

    def batch(self, executions: int) -> FixedOrder | None:
        """Return a session that goes on from here in so many executions, unless the plan needs more than an order."""
        if self.graph.requests or self.options.speed_profiles:
            return None
        return FixedOrder(self.graph, self.released, self.options.lookahead, executions)
