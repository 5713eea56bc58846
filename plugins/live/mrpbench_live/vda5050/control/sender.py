"""The orders of one vehicle: a base as far as the dispatcher has released its route, and a horizon.

An update stitches to the base that the vehicle has confirmed, so the next one waits until the one before is confirmed;
what is not confirmed is sent again as it is, which a vehicle that has it ignores (6.1.2).
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from mrpbench_core.api import Float, Route
from mrpbench_live.vda5050.control.itinerary import Itinerary, Stop
from mrpbench_live.vda5050.control.vehicle import ForeignVehicle
from mrpbench_live.vda5050.names import Names

REACH = 0.5
"""Metres from the first node of an order within which a vehicle can take it."""
PATIENCE_S = 2.0
"""Wall seconds after which a message that is not confirmed is sent again."""
THETA = "order.nodes.nodePosition.theta"
"""The optional parameter of orders that asks for an orientation."""
Send = Callable[[str, Mapping[str, Any]], bool]
"""Sends a message on a topic of the vehicle; tells whether there is a connection."""


class OrderSender:
    """Sends the orders of one vehicle.

    Args:
        vehicle: that gets them.
        itinerary: its route.
        names: of the version that it speaks.
        levels: names of the levels of the world, which are its maps.
        horizon: nodes after the base at most.
        prefix: of the ids of its orders.
        send: to the vehicle.
    """

    def __init__(
        self,
        vehicle: ForeignVehicle,
        itinerary: Itinerary,
        names: Names,
        levels: tuple[str, ...],
        horizon: int,
        prefix: str,
        send: Send,
    ) -> None:
        self.vehicle, self.itinerary = vehicle, itinerary
        self._names, self._levels, self._horizon, self._prefix, self._send = names, levels, horizon, prefix, send
        self.passed = 0
        """Moves that the vehicle has made, by what it reports."""
        self.refused: str | None = None
        """Why it refused the newest message; until the next plan it gets no other one."""
        self._base = self._shown = 0
        """Moves up to the decision point, and those that the vehicle had made when `places` was called before."""
        self._orders, self._order, self._update = 0, "", 0
        self._origin = 0
        """Moves before the first node of the order."""
        self._message: Mapping[str, Any] | None = None
        """What is not confirmed."""
        self._sent_at = -math.inf

    def adopt(self, route: Route, cut: int) -> None:
        """Continue with another plan, whose route leaves out the first `cut` segments."""
        self.itinerary.adopt(route, cut)
        self.refused = None

    def hear(self) -> None:
        """Take in what the vehicle says of its order."""
        vehicle = self.vehicle
        order, update = vehicle.order
        if order == self._order and vehicle.state is not None:
            passed = self._origin + int(vehicle.state["lastNodeSequenceId"]) // 2
            self.passed = max(self.passed, min(passed, self._base))
            if update >= self._update:
                self._message = None
                return
        if self._message is not None and (refusal := vehicle.refusal(self._order, self._update)) is not None:
            self.refused, self._message = refusal, None
            vehicle.say("order_refused", refusal)

    def step(self, allowed: int, now: float) -> None:
        """Send what the vehicle needs to make the moves that it is allowed to.

        Args:
            allowed: moves since the beginning of the run.
            now: time of `time.monotonic`.
        """
        vehicle = self.vehicle
        if not vehicle.online or vehicle.unusable or self.refused is not None:
            return
        if self._message is not None:
            if now >= self._sent_at + PATIENCE_S:
                self._publish(self._message, now)
        elif not self._has_order:
            lost = self._order and self.passed < self._base
            if lost and not vehicle.idle:
                return  # it has an order of somebody else
            if lost:
                vehicle.say("order_lost", f"{self._order} ended {self._base - self.passed} nodes before its base")
            if lost or allowed > self._base:
                self._begin(allowed, now)
        elif allowed > self._base:
            if vehicle.idle:
                self._begin(allowed, now)
            else:
                self._update += 1
                self._publish_order(self._base, allowed, now)

    def places(self) -> Float:
        """Return the places f8[k,2] (metres) of nodes to the decision point, see `OutsideRobots.route`."""
        nodes = range(max(self._shown, self.itinerary.first), min(self._base, self.itinerary.length) + 1)
        self._shown = self.passed
        stops = [self.itinerary.stop(moves) for moves in nodes]
        return np.array([(stop.x, stop.y) for stop in stops]).reshape(-1, 2)

    @property
    def _has_order(self) -> bool:
        """True if the vehicle has our order, and has not ended it before the end of its base."""
        if self.vehicle.order[0] != self._order or not self._order:
            return False
        return not self.vehicle.idle or self.passed >= self._base

    def _begin(self, allowed: int, now: float) -> None:
        self._orders += 1
        self._order, self._update, self._origin = f"{self._prefix}-{self._orders}", 0, self.passed
        self._publish_order(self.passed, max(allowed, self._base), now)

    def _publish_order(self, first: int, base: int, now: float) -> None:
        message = self._made(first, base, min(base + self._horizon, self.itinerary.length))
        self._base = base
        self._message = message
        self._publish(message, now)

    def _publish(self, message: Mapping[str, Any], now: float) -> None:
        self._send("order", message)
        self._sent_at = now

    def _made(self, first: int, base: int, last: int) -> Mapping[str, Any]:
        """Make an order from one node to another, all counted in moves."""
        nodes: list[dict[str, Any]] = []
        edges: list[dict[str, Any]] = []
        for moves in range(first, last + 1):
            stop, sequence = self.itinerary.stop(moves), 2 * (moves - self._origin)
            nodes.append(self._node(stop, sequence, moves <= base))
            if moves > first:
                ends = nodes[-2]["nodeId"], nodes[-1]["nodeId"]
                edges.append(self._edge(ends, sequence - 1, moves <= base, stop.speed))
        return {"orderId": self._order, "orderUpdateId": self._update, "nodes": nodes, "edges": edges}

    def _node(self, stop: Stop, sequence: int, released: bool) -> dict[str, Any]:
        level = self._levels[stop.level]
        position: dict[str, Any] = {"x": stop.x, "y": stop.y, "mapId": level}
        if math.isfinite(stop.yaw) and self.vehicle.supports(THETA):
            position["theta"] = math.remainder(stop.yaw, 2 * math.pi)
        if sequence == 0:  # where the vehicle stands, which it need not do exactly
            position["allowedDeviationXY"] = self._names.allowed_deviation(REACH)
        return {
            "nodeId": f"{level}:{stop.x:g},{stop.y:g}",
            "sequenceId": sequence,
            "released": released,
            "nodePosition": position,
            "actions": [],
        }

    def _edge(self, ends: tuple[str, str], sequence: int, released: bool, speed: float) -> dict[str, Any]:
        edge = {"edgeId": f"{ends[0]}-{ends[1]}", "sequenceId": sequence, "released": released, "actions": []}
        if not self._names.single:  # fields of 2.1
            edge |= {"startNodeId": ends[0], "endNodeId": ends[1]}
        return edge if math.isinf(speed) else edge | {self._names.maximum_speed: speed}
