"""Listens to a fleet control and its vehicles, and compares what it sends with what the vehicles say."""

import time
from collections.abc import Mapping
from typing import Any

import attrs

from mrpbench_live.vda5050 import orders
from mrpbench_live.vda5050.check.messages import RULES as MESSAGE_RULES
from mrpbench_live.vda5050.check.messages import MessageCheck
from mrpbench_live.vda5050.check.rules import PASSED, Report
from mrpbench_live.vda5050.names import VERSIONS, Names
from mrpbench_live.vda5050.orders import RefusedError
from mrpbench_live.vda5050.wire import Broker, Client, Wire

RULES = MESSAGE_RULES | {
    "order": "orders come to some vehicle (6.1)",
    "structure": "sequenceIds have no gaps, edges are nodes less one, and a base comes before its horizon (6.1.1)",
    "new_order": "a new order begins with the orderUpdateId 0 (6.1.2)",
    "idle": "a vehicle gets a new order only when it has no other one (6.1.4.6)",
    "update_ids": "an update has a higher orderUpdateId (6.1.2)",
    "stitching": "an update begins with the decision point, unchanged (6.1.2)",
    "base": "nodes of the base before the decision point are not sent again (6.1.2)",
    "after_cancel": "no update follows cancelOrder (6.1.3.1)",
    "action_ids": "an actionId is used once (6.2)",
    "maps": "nodes are on maps that the vehicle has (6.1.4.10)",
    "new_base": "a vehicle that asks for a longer base (newBaseRequest) gets one within 10 s (6.6.3)",
    "accepted": "no order is refused by its vehicle (6.1.4)",
}
_REFUSALS = (
    *("VALIDATION_FAILURE", "UNSUPPORTED_PARAMETER", "INVALID_ORDER_ACTION", "OUTDATED_ORDER_UPDATE", "NO_STITCHING"),
    *("SAME_ORDER_UPDATE_ID", "ORDER_UPDATE_FOLLOWING_CANCEL", "OTHER_ORDER_ACTIVE", "START_NODE_OUT_OF_RANGE"),
    *("NO_ROUTE_TO_TARGET", "UNKNOWN_MAP_ID", "MOBILE_ROBOT_NOT_AVAILABLE"),
)
CONNECTING_S = 5.0
NEW_BASE_S = 10.0
"""Seconds within which a vehicle that asks for a longer base should have one."""


@attrs.define
class _Seen:
    """What is known of one vehicle."""

    order: Mapping[str, Any] | None = None
    state: Mapping[str, Any] | None = None
    cancelled: str | None = None
    asks_since: float | None = None
    actions: dict[str, tuple[Any, ...]] = attrs.field(factory=dict)


class ControlCheck:
    """Listens.

    Args:
        url: of the broker.
        version: `2.1` or `3.0`.
        prefix: of topics, up to the major version.
    """

    def __init__(self, url: str, version: str, prefix: str) -> None:
        self._names: Names = VERSIONS[version]
        self.report = Report(RULES)
        self._check = MessageCheck(version, self._names, self.report)
        self._vehicles = MessageCheck(version, self._names, Report(MESSAGE_RULES))  # which are not judged
        self._seen: dict[str, _Seen] = {}
        self._wire = Wire(Broker.of(url))
        root = prefix or self._names.topics
        topics = tuple(f"{root}/+/+/{name}" for name in ("order", "instantActions", "state"))
        self._client = Client(self._wire, f"mrpbench-check-{time.time_ns()}", None, topics, lambda: None, self.take)
        self._refusals = {self._names.error(kind, "")[0] for kind in _REFUSALS}

    def run(self, seconds: float) -> Report:
        """Listen for some seconds; return what was found."""
        self.connect()
        try:
            self.listen(time.monotonic() + seconds)
        finally:
            self._wire.close()
        heard = self.report.findings["order"].verdict == PASSED
        self.report.require("order", heard, f"no valid order came within {seconds:g} s")
        return self.report

    def connect(self) -> None:
        """Begin to listen.

        Raises:
            InputError: there is no broker.
        """
        self._wire.add(self._client)
        self._wire.meet(CONNECTING_S)

    def listen(self, until: float) -> None:
        """Listen until a time of `time.monotonic`."""
        self._wire.serve(until)

    def take(self, topic: str, payload: bytes) -> None:
        """Take in a message of the control or of a vehicle."""
        vehicle, _, kind = topic.rpartition("/")
        message = self._vehicles.read(topic, payload) if kind == "state" else self._check.read(topic, payload)
        if message is None:
            return
        seen = self._seen.setdefault(vehicle, _Seen())
        if kind == "order":
            self._order(seen, message)
        elif kind == "instantActions":
            self._instant(seen, message)
        else:
            self._state(seen, message)

    def _order(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        report = self.report
        report.keep("order")
        try:
            orders.check_structure(message)
        except RefusedError as fault:
            report.require("structure", False, str(fault), message)
            return
        report.keep("structure")
        known = seen.order
        if known is not None and known["orderId"] == message["orderId"]:
            if message["orderUpdateId"] == known["orderUpdateId"] and orders.content(message) == orders.content(known):
                return  # it repeats itself, which is no fault
            self._update(seen, known, message)
        else:
            self._new(seen, message)
        self._actions(seen, message)
        self._maps(seen, message)
        if seen.asks_since is not None:
            self.report.keep("new_base")
        seen.order, seen.asks_since = message, None

    def _new(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        update = message["orderUpdateId"]
        self.report.require("new_order", update == 0, f"order {message['orderId']!r} begins with {update}", message)
        state = seen.state
        if seen.order is not None and state is not None and seen.cancelled != seen.order["orderId"]:
            held = state["orderId"] == seen.order["orderId"]
            busy = bool(state["nodeStates"] or state["edgeStates"]) or not held
            what = f"order {message['orderId']!r} while {seen.order['orderId']!r} has nodes left"
            self.report.require("idle", not busy, what, message)

    def _update(self, seen: _Seen, known: Mapping[str, Any], message: Mapping[str, Any]) -> None:
        report, name = self.report, f"order {message['orderId']!r}"
        one, other = known["orderUpdateId"], message["orderUpdateId"]
        report.require("update_ids", other > one, f"{name}: orderUpdateId {other} after {one}", message)
        late = seen.cancelled == message["orderId"]
        report.require("after_cancel", not late, f"{name} was cancelled", message)
        decision = [node for node in known["nodes"] if node["released"]][-1]
        first = message["nodes"][0]
        what = f"{name}: begins with {first['nodeId']!r}, the base ends with {decision['nodeId']!r}"
        report.require("stitching", _same_node(first, decision), what, message)
        again = first["sequenceId"] < decision["sequenceId"]
        report.require("base", not again, f"{name}: sequenceId {first['sequenceId']} is sent again", message)

    def _actions(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        for part in (*message["nodes"], *message["edges"]):
            for action in part["actions"]:
                place = message["orderId"], part["sequenceId"], action["actionType"]
                known = seen.actions.setdefault(action["actionId"], place)
                what = f"actionId {action['actionId']!r} is used for {known} and {place}"
                self.report.require("action_ids", known == place, what, message)

    def _maps(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        maps = {it["mapId"] for it in (seen.state or {}).get("maps", ())}
        if maps:
            used = {node["nodePosition"]["mapId"] for node in message["nodes"] if "nodePosition" in node}
            unknown = ", ".join(sorted(used - maps))
            self.report.require("maps", not unknown, f"unknown maps: {unknown}", message)

    def _instant(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        for action in message["actions"]:
            if action["actionType"] == "cancelOrder" and seen.order is not None:
                seen.cancelled = seen.order["orderId"]

    def _state(self, seen: _Seen, message: Mapping[str, Any]) -> None:
        seen.state, now = message, time.monotonic()
        for error in message["errors"]:
            kind = error["errorType"]
            what = f"{kind}: {error.get('errorDescription', '')}"
            self.report.require("accepted", kind not in self._refusals, what, message)
        if seen.order is not None:
            self.report.keep("accepted")
        if not message.get("newBaseRequest"):
            seen.asks_since = None
        elif seen.asks_since is None:
            seen.asks_since = now
        else:
            waited = now - seen.asks_since
            self.report.require("new_base", waited <= NEW_BASE_S, f"no update after {waited:.0f} s", message)


def _same_node(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Tell whether two nodes are the same; positions and actions must not change."""
    keys = "nodeId", "sequenceId", "nodePosition", "actions"
    return all(one.get(key) == other.get(key) for key in keys)
