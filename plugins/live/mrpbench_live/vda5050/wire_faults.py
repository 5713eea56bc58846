"""Faults of the wire between vehicles and fleet control: lost, doubled and late messages, and cut connections."""

import heapq
import itertools
import time
from collections.abc import Callable

import attrs
import numpy as np
from attrs.validators import ge

from mrpbench_core.api import between, option
from mrpbench_live.vda5050.wire import Wire


@attrs.frozen(kw_only=True)
class WireFaults:
    """How often messages of orders, instant actions, states and visualizations fare badly; on the way in, and out."""

    lost: float = option(0.0, help="share of messages that are lost", validator=between(0, 1))
    doubled: float = option(0.0, help="share of messages that come twice", validator=between(0, 1))
    late: float = option(0.0, help="share of messages that come late, after others", validator=between(0, 1))
    delay: float = option(1.0, help="wall time by which messages are late", unit="s", validator=ge(0))
    cut_every: float = option(
        0.0,
        help="simulated time from one cut of all connections to the next; 0: there are none",
        unit="s",
        validator=ge(0),
    )
    cut_for: float = option(2.0, help="wall time for which connections are cut", unit="s", validator=ge(0))
    seed: int = option(0, help="of these faults", validator=ge(0))


class FaultyWire:
    """Carries messages, some of them badly.

    Args:
        faults: how often.
        wire: whose connections are cut.
    """

    def __init__(self, faults: WireFaults, wire: Wire) -> None:
        self._faults, self._wire = faults, wire
        self._random = np.random.default_rng(faults.seed)
        self._active = bool(faults.lost or faults.doubled or faults.late)
        self._late: list[tuple[float, int, Callable[[], object]]] = []
        self._numbers = itertools.count()
        self._cut_at = faults.cut_every

    def carry(self, deliver: Callable[[], object]) -> None:
        """Deliver a message once, twice, later or never."""
        if not self._active:
            deliver()
            return
        faults, (lost, doubled, late) = self._faults, self._random.random(3).tolist()
        if lost < faults.lost:
            return
        for _ in range(1 + (doubled < faults.doubled)):
            if late < faults.late:
                heapq.heappush(self._late, (time.monotonic() + faults.delay, next(self._numbers), deliver))
            else:
                deliver()

    def advance(self, now: float) -> bool:
        """Deliver what is late, and cut connections if it is time to, in simulated seconds; tell whether they are."""
        while self._late and self._late[0][0] <= time.monotonic():
            heapq.heappop(self._late)[2]()
        if not self._faults.cut_every or now < self._cut_at - 1e-9:
            return False
        self._cut_at = now + self._faults.cut_every
        self._wire.cut(self._faults.cut_for)
        return True
