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
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_dispatchers_reordering.alternative_graph import MILLISECONDS
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
        super().__init__(options, problem, plan)
        self.searched = -math.inf
        """Simulated seconds of the last search."""
        self.lateness = self.progress.driven
        """Seconds f8[n] by which robots were late then."""

    def update(self, now: float, view: FleetView) -> Orders:
        """Change the order if robots are late and that helps; release the moves that no longer wait for anything."""
        self.observe(now, view)
        if self._is_due(now):
            self.searched, self.lateness = now, self.progress.lateness
            self._reorder(view)
        return super().update(now, view)

    def _is_due(self, now: float) -> bool:
        if not len(self.moves.robot) or now - self.searched < self.options.period - 1e-9:
            return False
        changes = np.abs(self.progress.lateness - self.lateness)
        return bool((changes >= self.options.lateness).any())

    def _reorder(self, view: FleetView) -> None:
        graph = self.next_decisions(view)
        if not len(graph.pairs.first):
            return
        limit = self.options.probe_limit
        found = reorder(**graph.arrays, wall_s=math.inf, memory_bytes=MEMORY_BYTES, probe_limit=limit)
        if found.planned_cost - found.cost >= self.options.gain * MILLISECONDS:
            self.put_next(graph.order(found.switched.astype(bool)))
