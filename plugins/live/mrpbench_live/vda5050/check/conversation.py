"""The connection of a check with one vehicle: what it sends, and what the vehicle says."""

import itertools
import json
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mrpbench_live.vda5050.check.messages import MessageCheck
from mrpbench_live.vda5050.check.rules import Report
from mrpbench_live.vda5050.messages import Headers
from mrpbench_live.vda5050.names import VERSIONS
from mrpbench_live.vda5050.wire import Broker, Client, Wire

State = Mapping[str, Any]


class Conversation:
    """Speaks with one vehicle.

    Args:
        url: of the broker.
        version: `2.1` or `3.0`.
        prefix: of topics, up to the major version.
        manufacturer: of the vehicle.
        serial: number of the vehicle.
        patience: seconds to wait for each answer.
        report: to which each message of the vehicle is checked.
    """

    def __init__(
        self, url: str, version: str, prefix: str, manufacturer: str, serial: str, patience: float, report: Report
    ) -> None:
        self.names, self.patience = VERSIONS[version], patience
        self._check = MessageCheck(version, self.names, report)
        self.topic = f"{prefix or self.names.topics}/{manufacturer}/{serial}/"
        self._headers = Headers(self.names.version, manufacturer, serial)
        self._wire = Wire(Broker.of(url))
        self.newest: dict[str, State] = {}
        """The newest valid message of the vehicle on each topic."""
        self.count: dict[str, int] = {}
        """How many there were."""
        self.states: list[State] | None = None
        """All states, where they are kept."""
        self._ids = itertools.count(int(time.time()))
        topics = tuple(self.topic + name for name in ("state", "connection", "factsheet", "visualization"))
        self._client = Client(self._wire, f"mrpbench-check-{time.time_ns()}", None, topics, lambda: None, self._take)
        self._wire.add(self._client)
        self._wire.meet(patience)

    def close(self) -> None:
        """End."""
        self._wire.close()

    def order_of(
        self, nodes: Sequence[tuple[float, list[Any]]], id: str | None = None, map: str | None = None
    ) -> dict[str, Any]:
        """An order along nodes: metres from the vehicle, and actions."""
        place = self.state.get(self.names.position, {"x": 0.0, "y": 0.0, "mapId": ""})
        made = [
            {
                "nodeId": self.new_id(),
                "sequenceId": 2 * index,
                "released": True,
                "nodePosition": {"x": place["x"] + away, "y": place["y"], "mapId": map or place["mapId"]},
                "actions": actions,
            }
            for index, (away, actions) in enumerate(nodes)
        ]
        return {"orderId": id or self.new_id(), "orderUpdateId": 0, "nodes": made, "edges": []}

    def order_to(self, there: tuple[float, float], **edge: Any) -> dict[str, Any]:
        """An order along one edge, with some more fields, from where the vehicle is to a place (metres)."""
        order, here = self.order_of([(0.0, []), (0.0, [])]), self.state[self.names.position]
        start, end = order["nodes"]
        start["nodePosition"]["allowedDeviationXY"] = self.names.allowed_deviation(0.5)
        end["nodePosition"] = {"x": there[0], "y": there[1], "mapId": here["mapId"]}
        made = {"edgeId": self.new_id(), "sequenceId": 1, "released": True, "actions": [], **edge}
        if not self.names.single:  # fields of 2.1
            made |= {"startNodeId": start["nodeId"], "endNodeId": end["nodeId"]}
        return {**order, "edges": [made]}

    def act(self, kind: str, **parameters: str) -> str:
        """Send an instant action; return its id."""
        key = self.new_id()
        action: dict[str, Any] = {"actionType": kind, "actionId": key, "blockingType": "NONE"}
        if parameters:
            action["actionParameters"] = [{"key": name, "value": value} for name, value in parameters.items()]
        self.publish("instantActions", {"actions": [action]})
        return key

    def header(self, topic: str) -> dict[str, Any]:
        """Return the header of the next message on a topic."""
        return self._headers.next(topic)

    @property
    def address(self) -> str:
        """The address of this machine from which the broker is reached."""
        return str(self._client.mqtt.socket().getsockname()[0])

    def publish(self, topic: str, body: Mapping[str, Any]) -> None:
        """Send a message; a body that has a header keeps it."""
        message = body if "headerId" in body else {**self._headers.next(topic), **body}
        self._client.publish(self.topic + topic, json.dumps(message).encode())

    def _take(self, topic: str, payload: bytes) -> None:
        kind = topic.rpartition("/")[2]
        message = self._check.read(topic, payload, retained=kind in ("connection", "factsheet"))
        if message is not None:
            self.newest[kind] = message
            self.count[kind] = self.count.get(kind, 0) + 1
            if kind == "state" and self.states is not None:
                self.states.append(message)

    def wait(self, topic: str, holds: Callable[[State], bool], seconds: float | None = None) -> bool:
        """Wait until the newest message of a topic has a property."""
        until = time.monotonic() + (self.patience if seconds is None else seconds)
        while not (topic in self.newest and holds(self.newest[topic])):
            if time.monotonic() > until:
                return False
            self._wire.serve(time.monotonic() + 0.02)
        return True

    def is_held(self, order: State, update: int) -> bool:
        """Wait until the vehicle has an order; tell whether it does."""
        wanted = order["orderId"], update
        return self.wait("state", lambda it: (it["orderId"], it["orderUpdateId"]) == wanted)

    def status(self, state: State, action: str) -> str:
        """The status of an instant action."""
        states = state.get("instantActionStates", ()) if self.names.has_instant_states else state["actionStates"]
        return next((str(it["actionStatus"]) for it in states if it["actionId"] == action), "none")

    @property
    def state(self) -> State:
        """The newest state of the vehicle."""
        return self.newest["state"]

    def new_id(self) -> str:
        """Return an id that was not used before."""
        return f"mrpbench-{next(self._ids)}"
