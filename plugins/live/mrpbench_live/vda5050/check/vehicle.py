"""Asks a vehicle: sends it orders and actions that it has to accept or to refuse, none of which moves it.

`areas` asks about corridors and zones.
"""

from mrpbench_live.vda5050.check.areas import RULES as AREA_RULES
from mrpbench_live.vda5050.check.areas import AreaCheck
from mrpbench_live.vda5050.check.conversation import Conversation, State
from mrpbench_live.vda5050.check.messages import RULES as MESSAGE_RULES
from mrpbench_live.vda5050.check.rules import Report

RULES = {
    **MESSAGE_RULES,
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
    **AREA_RULES,
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


class VehicleCheck:
    """Asks one vehicle.

    Args:
        conversation: with the vehicle; it is closed at the end.
        report: of `RULES`, to which the conversation checks each message.
        drive: x, y (metres): where the vehicle may drive, and back; None: nothing moves it.
    """

    def __init__(self, conversation: Conversation, report: Report, drive: tuple[float, float] | None = None) -> None:
        self._with, self.report, self._drive = conversation, report, drive

    def run(self) -> Report:
        """Ask everything; return what was found."""
        try:
            self._presence()
            if "state" in self._with.newest:
                self._instant_actions()
                self._refusals_when_idle()
                self._order()
                AreaCheck(self._with, self.report, self._drive).run()
        finally:
            self._with.close()
        return self.report

    # What is asked

    def _presence(self) -> None:
        seen = self._with.wait("state", lambda _: True, STATE_S)
        self.report.require("state", seen, f"no valid state on {self._with.topic}state within {STATE_S:g} s")
        online = self._with.wait("connection", lambda it: it["connectionState"] == "ONLINE")
        found = self._with.newest.get("connection", {}).get("connectionState", "no message came")
        self.report.require("connection", online, f"connectionState: {found}", self._with.newest.get("connection"))
        if not seen:
            for name in list(RULES)[list(RULES).index("state") + 1 :]:
                self.report.skip(name, "the vehicle sends no state")

    def _instant_actions(self) -> None:
        before = self._with.count["state"]
        key = self._with.act("stateRequest")
        done = self._with.wait("state", lambda it: self._with.status(it, key) == "FINISHED")
        what = f"the action has the status {self._with.status(self._with.state, key)}"
        self.report.require("state_request", done and self._with.count["state"] > before, what, self._with.state)
        before = self._with.count.get("factsheet", 0)
        self._with.act("factsheetRequest")
        found = self._with.wait("factsheet", lambda _: self._with.count["factsheet"] > before)
        self.report.require("factsheet", found, f"no valid factsheet within {self._with.patience:g} s")
        key = self._with.act("mrpbenchUnknownAction")
        self._refused("unknown_action", key)
        key = self._with.act("cancelOrder")
        self._refused("nothing_to_cancel", key)

    def _refusals_when_idle(self) -> None:
        place = self._with.state.get(self._with.names.position)
        self._send_order(self._with.order_of([], id=self._with.new_id()), "malformed")
        if place is None:
            for name in ("unknown_order_action", "unknown_map", "out_of_range"):
                self.report.skip(name, f"the state has no {self._with.names.position}")
            return
        unknown = {"actionType": "mrpbenchUnknown", "actionId": self._with.new_id(), "blockingType": "HARD"}
        self._send_order(self._with.order_of([(0.0, [unknown])]), "unknown_order_action")
        self._send_order(self._with.order_of([(0.0, [])], map="mrpbench-unknown-map"), "unknown_map")
        self._send_order(self._with.order_of([(1000.0, [])]), "out_of_range")

    def _order(self) -> None:
        if self._with.state.get(self._with.names.position) is None:
            for name in ("accepted", "first_node", "errors_end", "repetition", "same_update", "updated"):
                self.report.skip(name, f"the state has no {self._with.names.position}")
            return
        order = self._with.order_of([(0.0, [])])
        self._with.publish("order", order)
        if not self.report.require(
            "accepted", self._with.is_held(order, 0), "the order is not in the state", self._with.state
        ):
            for name in ("first_node", "errors_end", "repetition", "same_update", "updated", "stitching", "outdated"):
                self.report.skip(name, "no order was accepted")
            return
        node = order["nodes"][0]["nodeId"]
        state = self._with.state
        kept = state["lastNodeId"] == node and not state["nodeStates"]
        self.report.require("first_node", kept, f"lastNodeId {state['lastNodeId']!r} instead of {node!r}", state)
        types = {self._with.names.error(kind, "")[0] for kind in _ERRORS.values() if kind != "INVALID_INSTANT_ACTION"}
        left = sorted({error["errorType"] for error in state["errors"]} & types)
        self.report.require("errors_end", not left, f"still there: {', '.join(left)}", state)
        before = len(self._with.state["errors"])
        self._with.publish("order", order)
        self._with.act("stateRequest")
        self._with.wait("state", lambda _: False, 1.0)
        what = "an error was reported, or the order changed"
        kept = len(self._with.state["errors"]) == before and self._with.state["orderUpdateId"] == 0
        self.report.require("repetition", kept, what, self._with.state)
        other = {**order, "nodes": [{**order["nodes"][0], "nodeId": self._with.new_id()}]}
        self._send_order(other, "same_update")
        update = {**order, "orderUpdateId": 1}
        self._with.publish("order", update)
        if not self.report.require("updated", self._with.is_held(order, 1), "orderUpdateId stays 0", self._with.state):
            return
        elsewhere = {**order["nodes"][0], "nodeId": self._with.new_id(), "sequenceId": 8}
        self._send_order({**order, "orderUpdateId": 2, "nodes": [elsewhere]}, "stitching")
        self._send_order(order, "outdated")

    # How it is asked

    def _send_order(self, order: State, rule: str) -> None:
        """Send an order that has to be refused."""
        before = {key: self._with.state[key] for key in ("orderId", "orderUpdateId", "lastNodeId", "nodeStates")}
        self._with.publish("order", order)
        self._refused(rule, None)
        after = {key: self._with.state[key] for key in before}
        self.report.require("refusals", after == before, f"after the order for {rule!r}: {after}", self._with.state)

    def _refused(self, rule: str, action: str | None) -> None:
        """Wait for the error that a rule asks for."""
        wanted = self._with.names.error(_ERRORS[rule], "WARNING")[0]

        def is_there(state: State) -> bool:
            return any(
                error["errorType"] == wanted
                and (action is None or action in [it["referenceValue"] for it in error.get("errorReferences", ())])
                for error in state["errors"]
            )

        found = self._with.wait("state", is_there)
        types = ", ".join(error["errorType"] for error in self._with.state["errors"]) or "none"
        about = f" about {action}" if action else ""
        self.report.require(rule, found, f"no error {wanted}{about}; errors: {types}", self._with.state)
        if action is not None and found:
            status = self._with.status(self._with.state, action)
            self.report.require(rule, status == "FAILED", f"the action has the status {status}", self._with.state)
