"""What dispatchers share that switch the order of two robots at places where both orders are possible."""

import copy
from typing import Self

import attrs
import numpy as np

from mrpbench_core.api import DispatchError, option
from mrpbench_core.dispatching.dependency_graph import REACHED
from mrpbench_core.dispatching.order_keeping import OrderKeepingDispatcher, OrderKeepingSession
from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import AlternativeGraph, State, alternative_graph
from mrpbench_dispatchers_reordering.progress import Progress
from mrpbench_dispatchers_reordering.visits import Conflicts, at_times, visits_of


@attrs.frozen(kw_only=True)
class SwitchingDispatcher(OrderKeepingDispatcher):
    """Releases moves in an order that may change."""

    lookahead: int = option(
        4,
        help="segments released at most beyond the one under way; their order cannot change any more",
        validator=attrs.validators.ge(1),
    )
    horizon: float = option(
        60.0,
        help="time from now in which robots begin the moves whose order may change, if they do not wait",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    move_limit: int = option(
        10_000,
        help="moves among which orders may change at once; large fleets have a shorter horizon",
        validator=attrs.validators.ge(0),
    )


class SwitchingSession(OrderKeepingSession):
    """Releases one plan after another, each at first in its own order."""

    options: SwitchingDispatcher

    def __init__(self, options: SwitchingDispatcher, problem: Problem, plan: Plan) -> None:
        self.progress = Progress(len(problem))
        super().__init__(options, problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with `plan`, in its order; released segments remain released.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        super().adopt(problem, plan, cut)
        self.moves = self.graph.moves
        """The moves at times that imply the current order."""
        self.visits = visits_of(problem, self.moves)
        self.conflicts = Conflicts(problem)
        self.progress.use(problem, self.moves, cut)

    def _copied(self) -> Self:
        twin = super()._copied()
        twin.progress = copy.copy(self.progress)
        return twin

    def observe(self, now: float, view: FleetView) -> None:
        """Take note of the progress of the robots."""
        self.progress.update(now, np.maximum(self.counts, (view.reached, view.cleared))[REACHED], self.released)

    def update(self, now: float, view: FleetView) -> Orders:
        """Release the moves that no longer wait for anything."""
        orders = super().update(now, view)
        self.observe(now, view)
        return orders

    def next_decisions(self, view: FleetView) -> AlternativeGraph:
        """What may be decided next about the order."""
        counts = np.maximum(self.counts, (view.reached, view.cleared))
        state = State(counts, self.released, self.progress)
        horizon, limit = self.options.horizon, self.options.move_limit
        return alternative_graph(self.graph, self.conflicts, self.visits, state, horizon, limit)

    def put_next(self, moves: Int) -> bool:
        """Let `moves` i8[c], of which none is released, use places in this order after released ones and before all
        others, whose order remains; return False, with the order as it was, if that is not safe.
        """
        timed = self.moves
        released = timed.segment < self.released[timed.robot]
        others = ~released
        others[moves] = False
        enter, leave = timed.enter.copy(), timed.leave.copy()
        latest = max(leave[released].max(initial=0), self.problem.since.max(initial=0))
        enter[moves] = latest + 2 * np.arange(len(moves))
        leave[moves] = enter[moves] + 1
        shift = max(0, int(latest) + 2 * len(moves) - int(enter[others].min(initial=np.iinfo(np.int64).max)))
        enter[others] += shift
        leave[others] += shift
        over = timed.segment < self.counts.min(axis=0)[timed.robot]
        try:
            self.retime(timed._replace(enter=enter, leave=leave), ~others & ~over)
        except DispatchError:
            return False
        self.moves = timed._replace(enter=enter, leave=leave)
        self.visits = at_times(self.visits, self.moves)
        return True
