"""The dispatcher `gses`: changes the order of a plan when robots are late, so that all arrive earlier.

Feng, Paul, Chen and Li, "A real-time rescheduling algorithm for multi-robot plan execution" (GSES), ICAPS 2024; Jiang,
Lin and Li, "Speedup techniques for switchable temporal plan graph optimization", AAAI 2025. `reorder` of
`mrpbench_native.mapf` searches. This package derives from the rules of conflicts what may be switched. Every new order
is verified like that of a plan (`mrpbench_core.dispatching`) before robots follow it.
"""

import math
from collections.abc import Mapping

import attrs
from mrpbench_native.mapf import reorder

from mrpbench_core.api import option
from mrpbench_core.model.common.arrays import Bool, Int32
from mrpbench_dispatchers_reordering.searching import SearchingDispatcher

MEMORY_BYTES = 1 << 30


@attrs.frozen(kw_only=True)
class Gses(SearchingDispatcher):
    """Releases moves in the order that lets robots arrive earliest, given how late they are."""

    work_limit: int = option(
        100_000,
        help="times of events that one search computes, after which the best order found is taken",
        validator=attrs.validators.ge(0),
    )

    def search(self, arrays: Mapping[str, Int32]) -> tuple[Bool, int]:
        """See `SearchingDispatcher.search`."""
        result = reorder(**arrays, wall_s=math.inf, memory_bytes=MEMORY_BYTES, work_limit=self.work_limit)
        return result.switched.astype(bool), result.planned_cost - result.cost
