"""What dispatchers share that search for the best order among those that are possible."""

import math
from abc import abstractmethod
from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.api import option
from mrpbench_core.model.common.arrays import Bool, Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import MILLISECONDS, AlternativeGraph
from mrpbench_dispatchers_reordering.switching import SwitchingDispatcher, SwitchingSession


@attrs.frozen(kw_only=True)
class SearchingDispatcher(SwitchingDispatcher):
    """Releases moves in an order that is searched for again and again."""

    period: float = option(1.0, help="least time between two searches", unit="s", validator=attrs.validators.ge(0))
    lateness: float = option(
        1.0,
        help="search again when a robot has lost or made up at least so much time since the last search",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    gain: float = option(
        1.0,
        help="decrease of the expected sum of arrivals from which on an order is changed",
        unit="s",
        validator=attrs.validators.gt(0),
    )

    @abstractmethod
    def search(self, arrays: Mapping[str, Int32]) -> tuple[Bool, int] | None:
        """Return which alternatives bool[k] are best switched, and by how many ms arrivals fall in sum; None: no order.

        Args:
            arrays: `AlternativeGraph.arrays`.
        """

    def start(self, problem: Problem, plan: Plan) -> "SearchingSession":
        """Begin to release a plan.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        return SearchingSession(self, problem, plan)


class SearchingSession(SwitchingSession):
    """Releases one plan after another, each at first in its own order."""

    options: SearchingDispatcher

    def __init__(self, options: SearchingDispatcher, problem: Problem, plan: Plan) -> None:
        super().__init__(options, problem, plan)
        self.searched = -math.inf
        """Simulated seconds of the last search."""
        self.lateness = self.progress.driven
        """Seconds f8[n] by which robots were late then."""

    def copied(self) -> "SearchingSession":
        """Return a session that goes on from here by itself."""
        return self._copied()

    def update(self, now: float, view: FleetView) -> Orders:
        """Change the order if robots are late and that helps; release the moves that no longer wait for anything."""
        self.observe(now, view)
        if self._is_due(now):
            self.searched, self.lateness = now, self.progress.lateness
            graph = self.next_decisions(view)
            if len(graph.pairs.first):
                self._change(graph)
        return super().update(now, view)

    def _is_due(self, now: float) -> bool:
        if not len(self.moves.robot) or now - self.searched < self.options.period - 1e-9:
            return False
        changes = np.abs(self.progress.lateness - self.lateness)
        return bool((changes >= self.options.lateness).any())

    def _change(self, graph: AlternativeGraph) -> None:
        change = self.options.search(graph.arrays)
        if change is not None and change[1] >= self.options.gain * MILLISECONDS:
            self.put_next(graph.order(change[0]))
