"""What dispatchers share that switch the order of two robots at places where both orders are possible."""

import attrs
import numpy as np

from mrpbench_core.api import DispatchError, option
from mrpbench_core.dispatching.order_keeping import OrderKeepingDispatcher, OrderKeepingSession
from mrpbench_core.model.common.arrays import Bool, Int32
from mrpbench_core.model.planning.occupations import resource_edges
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.type2_edges import without_implied
from mrpbench_dispatchers_reordering.visits import Pairs, conflicting, order_of, visits_of


@attrs.frozen(kw_only=True)
class SwitchingDispatcher(OrderKeepingDispatcher):
    """Releases moves in an order that may change."""

    lookahead: int = option(
        4,
        help="segments released at most beyond the one under way; their order cannot change any more",
        validator=attrs.validators.ge(1),
    )


class SwitchingSession(OrderKeepingSession):
    """Releases one plan after another, each at first in its own order."""

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with `plan`, in its order; released segments remain released.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        super().adopt(problem, plan, cut)
        moves = self.graph.moves
        self.visits = visits_of(problem, moves)
        self.pairs = conflicting(problem, self.visits)
        self.resources = resource_edges(problem, self.graph.occupations)

    def switch(self, switched: Bool) -> bool:
        """Reverse the pairs `switched` bool[p]; return False, with the order as it was, if that is not safe."""
        order = order_of(self.visits, self.pairs, switched, self.resources)
        try:
            self.keep(self.problem, self.plan, without_implied(self.graph.moves, order))
        except DispatchError:
            return False
        first, second = self.pairs
        self.pairs = Pairs(np.where(switched, second, first), np.where(switched, first, second))
        return True
