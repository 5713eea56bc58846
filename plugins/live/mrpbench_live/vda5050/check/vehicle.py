"""Asks a vehicle: sends it orders and actions that it has to accept or to refuse, none of which moves it."""

import itertools
import json
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mrpbench_live.vda5050.check.messages import RULES as MESSAGE_RULES
from mrpbench_live.vda5050.check.messages import MessageCheck
from mrpbench_live.vda5050.check.rules import Report
from mrpbench_live.vda5050.messages import Headers
from mrpbench_live.vda5050.names import VERSIONS
from mrpbench_live.vda5050.wire import Broker, Client, Wire

RULES = MESSAGE_RULES | {
    "connection": "the vehicle is ONLINE, in a retained message (6.5)",
    "state": "a state comes at least every 30 s (6.6)",
    "state_request": "stateRequest is answered by a state, and is FINISHED (6.2.3)",
    "factsheet": "factsheetRequest is answered by a factsheet (6.2.3)",
    "unknown_action": "an unknown instant action FAILS, with an error that names its actionId (6.2.1)",
    "nothing_to_cancel": "cancelOrder without an order FAILS, with an error (6.1.3.2)",
    "malformed": "an order without nodes is refused as malformed (6.1.4.1)",
    "unknown_order_action": "an order with an unknown action is refused (6.1.4.3)",
    "unknown_map": "an order on an unknown map is refused (6.1.4.10)",
    "out_of_range": "an order that begins elsewhere is refused (6.1.4.7)",
    "accepted": "an order that begins where the vehicle stands is accepted, and is the one in its state (6.1.2)",
    "first_node": "the first node of an order counts as traversed at once (6.1.1)",
    "errors_end": "errors about orders end when an order is accepted (6.6.5)",
    "repetition": "the same order again changes nothing and is no error (6.1.4.5)",
    "same_update": "the same orderUpdateId with other content is refused (6.1.4.5)",
    "updated": "an update that begins at the decision point is accepted (6.1.2)",
    "stitching": "an update that begins elsewhere is refused (6.1.2)",
    "outdated": "a lower orderUpdateId is refused (6.1.4.4)",
    "refusals": "a refused order leaves the running one alone (6.1.4)",
}
_ERRORS = {
    "unknown_action": "INVALID_INSTANT_ACTION",
    "nothing_to_cancel": "NO_ORDER_TO_CANCEL",
    "malformed": "VALIDATION_FAILURE",
    "unknown_order_action": "INVALID_ORDER_ACTION",
    "unknown_map": "UNKNOWN_MAP_ID",
    "out_of_range": "START_NODE_OUT_OF_RANGE",
    "same_update": "SAME_ORDER_UPDATE_ID",
    "stitching": "NO_STITCHING",
    "outdated": "OUTDATED_ORDER_UPDATE",
}
STATE_S = 31.0
"""Seconds within which a state has to come, and one for what is on its way."""
State = Mapping[str, Any]


class VehicleCheck:
    """Asks one vehicle.

    Args:
        url: of the broker.
        version: `2.1` or `3.0`.
        prefix: of topics, up to the major version.
        manufacturer: of the vehicle.
        serial: number of the vehicle.
        patience: seconds to wait for each answer.
    """

    def __init__(self, url: str, version: str, prefix: str, manufacturer: str, serial: str, patience: float) -> None:
        self._names, self._patience = VERSIONS[version], patience
        self.report = Report(RULES)
        self._check = MessageCheck(version, self._names, self.report)
        self._topic = f"{prefix or self._names.topics}/{manufacturer}/{serial}/"
        self._headers = Headers(self._names.version, manufacturer, serial)
        self._wire = Wire(Broker.of(url))
        self._newest: dict[str, State] = {}
        self._count: dict[str, int] = {}
        self._ids = itertools.count(int(time.time()))
        topics = tuple(self._topic + name for name in ("state", "connection", "factsheet", "visualization"))
        self._client = Client(self._wire, f"mrpbench-check-{time.time_ns()}", None, topics, lambda: None, self._take)
        self._wire.add(self._client)
        self._wire.meet(patience)

    def run(self) -> Report:
        """Ask everything; return what was found."""
        try:
            self._presence()
            if "state" in self._newest:
                self._instant_actions()
                self._refusals_when_idle()
                self._order()
        finally:
            self._wire.close()
        return self.report

    # What is asked

    def _presence(self) -> None:
        seen = self._wait("state", lambda _: True, STATE_S)
        self.report.require("state", seen, f"no valid state on {self._topic}state within {STATE_S:g} s")
        online = self._wait("connection", lambda it: it["connectionState"] == "ONLINE")
        found = self._newest.get("connection", {}).get("connectionState", "no message came")
        self.report.require("connection", online, f"connectionState: {found}", self._newest.get("connection"))
        if not seen:
            for name in list(RULES)[list(RULES).index("state") + 1 :]:
                self.report.skip(name, "the vehicle sends no state")

    def _instant_actions(self) -> None:
        before = self._count["state"]
        key = self._act("stateRequest")
        done = self._wait("state", lambda it: self._status(it, key) == "FINISHED")
        what = f"the action has the status {self._status(self._state, key)}"
        self.report.require("state_request", done and self._count["state"] > before, what, self._state)
        before = self._count.get("factsheet", 0)
        self._act("factsheetRequest")
        found = self._wait("factsheet", lambda _: self._count["factsheet"] > before)
        self.report.require("factsheet", found, f"no valid factsheet within {self._patience:g} s")
        key = self._act("mrpbenchUnknownAction")
        self._refused("unknown_action", key)
        key = self._act("cancelOrder")
        self._refused("nothing_to_cancel", key)

    def _refusals_when_idle(self) -> None:
        place = self._state.get(self._names.position)
        self._send_order(self._order_of([], id=self._new_id()), "malformed")
        if place is None:
            for name in ("unknown_order_action", "unknown_map", "out_of_range"):
                self.report.skip(name, f"the state has no {self._names.position}")
            return
        unknown = {"actionType": "mrpbenchUnknown", "actionId": self._new_id(), "blockingType": "HARD"}
        self._send_order(self._order_of([(0.0, [unknown])]), "unknown_order_action")
        self._send_order(self._order_of([(0.0, [])], map="mrpbench-unknown-map"), "unknown_map")
        self._send_order(self._order_of([(1000.0, [])]), "out_of_range")

    def _order(self) -> None:
        if self._state.get(self._names.position) is None:
            for name in ("accepted", "first_node", "errors_end", "repetition", "same_update", "updated"):
                self.report.skip(name, f"the state has no {self._names.position}")
            return
        order = self._order_of([(0.0, [])])
        self._publish("order", order)
        if not self.report.require("accepted", self._is_held(order, 0), "the order is not in the state", self._state):
            for name in ("first_node", "errors_end", "repetition", "same_update", "updated", "stitching", "outdated"):
                self.report.skip(name, "no order was accepted")
            return
        node = order["nodes"][0]["nodeId"]
        state = self._state
        kept = state["lastNodeId"] == node and not state["nodeStates"]
        self.report.require("first_node", kept, f"lastNodeId {state['lastNodeId']!r} instead of {node!r}", state)
        types = {self._names.error(kind, "")[0] for kind in _ERRORS.values() if kind != "INVALID_INSTANT_ACTION"}
        left = sorted({error["errorType"] for error in state["errors"]} & types)
        self.report.require("errors_end", not left, f"still there: {', '.join(left)}", state)
        before = len(self._state["errors"])
        self._publish("order", order)
        self._act("stateRequest")
        self._wait("state", lambda _: False, 1.0)
        what = "an error was reported, or the order changed"
        kept = len(self._state["errors"]) == before and self._state["orderUpdateId"] == 0
        self.report.require("repetition", kept, what, self._state)
        other = {**order, "nodes": [{**order["nodes"][0], "nodeId": self._new_id()}]}
        self._send_order(other, "same_update")
        update = {**order, "orderUpdateId": 1}
        self._publish("order", update)
        if not self.report.require("updated", self._is_held(order, 1), "orderUpdateId stays 0", self._state):
            return
        elsewhere = {**order["nodes"][0], "nodeId": self._new_id(), "sequenceId": 8}
        self._send_order({**order, "orderUpdateId": 2, "nodes": [elsewhere]}, "stitching")
        self._send_order(order, "outdated")

    # How it is asked

    def _send_order(self, order: State, rule: str) -> None:
        """Send an order that has to be refused."""
        before = {key: self._state[key] for key in ("orderId", "orderUpdateId", "lastNodeId", "nodeStates")}
        self._publish("order", order)
        self._refused(rule, None)
        after = {key: self._state[key] for key in before}
        self.report.require("refusals", after == before, f"after the order for {rule!r}: {after}", self._state)

    def _refused(self, rule: str, action: str | None) -> None:
        """Wait for the error that a rule asks for."""
        wanted = self._names.error(_ERRORS[rule], "WARNING")[0]

        def is_there(state: State) -> bool:
            return any(
                error["errorType"] == wanted
                and (action is None or action in [it["referenceValue"] for it in error.get("errorReferences", ())])
                for error in state["errors"]
            )

        found = self._wait("state", is_there)
        types = ", ".join(error["errorType"] for error in self._state["errors"]) or "none"
        about = f" about {action}" if action else ""
        self.report.require(rule, found, f"no error {wanted}{about}; errors: {types}", self._state)
        if action is not None and found:
            status = self._status(self._state, action)
            self.report.require(rule, status == "FAILED", f"the action has the status {status}", self._state)

    def _order_of(
        self, nodes: Sequence[tuple[float, list[Any]]], id: str | None = None, map: str | None = None
    ) -> dict[str, Any]:
        """An order along nodes: metres from the vehicle, and actions."""
        place = self._state.get(self._names.position, {"x": 0.0, "y": 0.0, "mapId": ""})
        made = [
            {
                "nodeId": self._new_id(),
                "sequenceId": 2 * index,
                "released": True,
                "nodePosition": {"x": place["x"] + away, "y": place["y"], "mapId": map or place["mapId"]},
                "actions": actions,
            }
            for index, (away, actions) in enumerate(nodes)
        ]
        return {"orderId": id or self._new_id(), "orderUpdateId": 0, "nodes": made, "edges": []}

    def _act(self, kind: str) -> str:
        """Send an instant action; return its id."""
        key = self._new_id()
        self._publish("instantActions", {"actions": [{"actionType": kind, "actionId": key, "blockingType": "NONE"}]})
        return key

    def _publish(self, topic: str, body: Mapping[str, Any]) -> None:
        message = {**self._headers.next(topic), **body}
        self._client.publish(self._topic + topic, json.dumps(message).encode())

    def _take(self, topic: str, payload: bytes) -> None:
        kind = topic.rpartition("/")[2]
        message = self._check.read(topic, payload, retained=kind in ("connection", "factsheet"))
        if message is not None:
            self._newest[kind] = message
            self._count[kind] = self._count.get(kind, 0) + 1

    def _wait(self, topic: str, holds: Callable[[State], bool], seconds: float | None = None) -> bool:
        """Wait until the newest message of a topic has a property."""
        until = time.monotonic() + (self._patience if seconds is None else seconds)
        while not (topic in self._newest and holds(self._newest[topic])):
            if time.monotonic() > until:
                return False
            self._wire.serve(time.monotonic() + 0.02)
        return True

    def _is_held(self, order: State, update: int) -> bool:
        wanted = order["orderId"], update
        return self._wait("state", lambda it: (it["orderId"], it["orderUpdateId"]) == wanted)

    def _status(self, state: State, action: str) -> str:
        """The status of an instant action."""
        states = state.get("instantActionStates", ()) if self._names.has_instant_states else state["actionStates"]
        return next((str(it["actionStatus"]) for it in states if it["actionId"] == action), "none")

    @property
    def _state(self) -> State:
        return self._newest["state"]

    def _new_id(self) -> str:
        return f"mrpbench-{next(self._ids)}"
