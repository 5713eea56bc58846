"""Where a vehicle may be: within the corridors of its edges, and outside of BLOCKED zones (6.1.5, 6.4.1)."""

from collections.abc import Sequence

import numpy as np

from mrpbench_live.fleet.regions import placed
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.corridors import is_outside, of_contour
from mrpbench_live.vda5050.errors import Errors
from mrpbench_live.vda5050.orders import Edge, Node
from mrpbench_live.vda5050.track import Track


class Bounds:
    """Stops one vehicle where it may not be.

    Args:
        track: its path.
        errors: that it reports.
    """

    def __init__(self, track: Track, errors: Errors) -> None:
        self._track, self._errors = track, errors
        self.halted = False
        """The vehicle was where it may not be, and stands until it has another order."""
        self._barrier: int | None = None
        """Moves before the first one of the path that would enter a BLOCKED zone."""
        self._zone: str | None = None
        """The BLOCKED zone in which the vehicle is."""

    def resume(self) -> None:
        """Let the vehicle drive again, which has no order any more, or another one."""
        self.halted = False
        self._errors.correct("OUTSIDE_OF_CORRIDOR")

    def look_ahead(self, nodes: Sequence[Node]) -> None:
        """Find out whether the path to some nodes, which may be older than a zone, enters one; if so, report it."""
        self._barrier = barrier = self._track.barrier
        node = next((node for node in nodes if barrier is not None and node.mark > barrier), None)
        if node is not None:
            what = f"a BLOCKED zone is on the way to node {node.id!r}"
            self._errors.restrict("NODE_UNREACHABLE", what, {"nodeId": node.id})

    def limit(self, moves: int) -> int:
        """Return how many moves the vehicle may make, if its order allows so many."""
        return moves if self._barrier is None else min(moves, max(self._barrier, self._track.passed))

    def watch(self, here: Here, edge: Edge | None) -> None:
        """Stop the vehicle if it has left the corridor of `edge`, on which it is, or come into a BLOCKED zone."""
        corridor = None if edge is None else edge.corridor
        if edge is not None and corridor is not None and not self.halted:
            center = np.array([here.pose[:2]])
            place = placed(self._track.footprint, here.pose) if of_contour(corridor) else center
            if is_outside(corridor, edge.line, place):
                name = str(edge.message["edgeId"])
                self.halted = True
                what = f"the vehicle is outside of the corridor of {name!r}"
                self._errors.restrict("OUTSIDE_OF_CORRIDOR", what, {"edgeId": name})
        before, self._zone = self._zone, self._track.zones.violated(here)
        if self._zone is not None and before is None:
            self.halted = True
            what = f"the vehicle is in the BLOCKED zone {self._zone!r}"
            self._errors.restrict("BLOCKED_ZONE_VIOLATION", what, {"zoneId": self._zone})
        elif self._zone is None and before is not None:
            self._errors.correct("BLOCKED_ZONE_VIOLATION")
