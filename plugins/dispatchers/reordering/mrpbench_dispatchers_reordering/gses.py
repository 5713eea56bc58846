"""The dispatcher `gses`: changes the order of a plan when robots are late, so that all arrive earlier.

Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution" (GSES), ICAPS 2024; Jiang,
Lin and Li, "Speedup techniques for switchable temporal plan graph optimization", AAAI 2025. `reorder` of
`mrpbench_native.mapf` searches. This package derives from the rules of conflicts what may be switched. Every new order
is verified like that of a plan (`mrpbench_core.dispatching`) before robots follow it.
"""

import math

import attrs
import numpy as np
from mrpbench_native.mapf import reorder

from mrpbench_core.api import option
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import MILLISECONDS, State, alternative_graph
from mrpbench_dispatchers_reordering.progress import Progress
from mrpbench_dispatchers_reordering.switching import SwitchingDispatcher, SwitchingSession

MEMORY_BYTES = 1 << 30


@attrs.frozen(kw_only=True)
class Gses(SwitchingDispatcher):
    """Releases moves in the order that lets robots arrive earliest, given how late they are."""

    period: float = option(1.0, help="least time between two searches", unit="s", validator=attrs.validators.ge(0))
    lateness: float = option(
        1.0,
        help="search again when a robot has lost or made up at least so much time since the last search",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    horizon: float = option(
        60.0,
        help="planned time from now within which both robots begin to use a place if their order may change",
        unit="s",
        validator=attrs.validators.ge(0),
    )
    gain: float = option(
        1.0,
        help="decrease of the expected sum of arrivals from which on an order is changed",
        unit="s",
        validator=attrs.validators.gt(0),
    )
    probe_limit: int = option(
        2000,
        help="choices of which one search computes the consequences, after which the best order found is taken",
        validator=attrs.validators.ge(0),
    )

    def start(self, problem: Problem, plan: Plan) -> "GsesSession":
        """Begin to release a plan.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        return GsesSession(self, problem, plan)


class GsesSession(SwitchingSession):
    """Releases one plan after another, each at first in its own order."""

    options: Gses

    def __init__(self, options: Gses, problem: Problem, plan: Plan) -> None:
        self.progress = Progress(len(problem))
        self.searched = -math.inf
        """Simulated seconds of the last search."""
        self.lateness = self.progress.driven
        """Seconds f8[n] by which robots were late then."""
        super().__init__(options, problem, plan)

    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with `plan`, in its order; released segments remain released.

        Raises:
            DispatchError: as `OrderKeepingSession.adopt`.
        """
        super().adopt(problem, plan, cut)
        self.progress.use(problem, self.graph.moves, cut)

    def update(self, now: float, view: FleetView) -> Orders:
        """Change the order if robots are late and that helps; release the moves that no longer wait for anything."""
        seen = np.maximum(self.seen, (view.reached, view.cleared))
        self.progress.update(now, seen[0], self.released)
        if self._is_due(now):
            self.searched, self.lateness = now, self.progress.lateness
            self._reorder(State(seen, self.released, self.progress))
        orders = super().update(now, view)
        self.progress.update(now, seen[0], self.released)
        return orders

    def _is_due(self, now: float) -> bool:
        if now - self.searched < self.options.period - 1e-9:
            return False
        changes = np.abs(self.progress.lateness - self.lateness)
        return bool((changes >= self.options.lateness).any())

    def _reorder(self, state: State) -> None:
        if not len(self.graph.moves.robot):
            return
        graph = alternative_graph(self.graph, self.visits, self.pairs, self.resources, state, self.options.horizon)
        if not len(graph.open):
            return
        limit = self.options.probe_limit
        found = reorder(**graph.arrays, wall_s=math.inf, memory_bytes=MEMORY_BYTES, probe_limit=limit)
        if found.planned_cost - found.cost < self.options.gain * MILLISECONDS:
            return
        switched = np.zeros(len(self.pairs.first), bool)
        switched[graph.open] = found.switched.astype(bool)
        self.switch(switched)
