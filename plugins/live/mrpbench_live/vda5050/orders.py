"""Whether an order is accepted, and what is left of it (6.1).

An order that is refused changes nothing.
"""

from collections.abc import Collection, Iterable, Mapping
from typing import Any, Protocol

import attrs
import numpy as np

from mrpbench_core.api import Float
from mrpbench_live.vda5050.actions import STANDING, Action
from mrpbench_live.vda5050.names import Names

ANY_THETA = 3.14
"""Radians: a node that allows such a deviation asks for no orientation."""


class RefusedError(Exception):
    """An order or an instant action is refused.

    Args:
        kind: type of the error in 3.0.
        description: one line for people.
        references: what the error is about.
        level: of the error in 3.0.
    """

    def __init__(self, kind: str, description: str, references: Mapping[str, str], level: str = "WARNING") -> None:
        super().__init__(description)
        self.kind, self.references, self.level = kind, references, level


@attrs.define(kw_only=True)
class Node:
    """A node of an order."""

    message: Mapping[str, Any]
    vertex: int
    """Of the roadmap."""
    position: tuple[float, float]
    """metres."""
    any_heading: bool
    """It does not ask for an orientation."""
    deviation: float | None
    """Metres within which it counts as traversed; None: the vehicle decides."""
    actions: list[Action]
    mark: int = -1
    """Moves of the vehicle since the beginning of the run at which it is there."""

    @property
    def id(self) -> str:
        """The name that the fleet control gave it."""
        return str(self.message["nodeId"])

    @property
    def sequence(self) -> int:
        """Its place in the order."""
        return int(self.message["sequenceId"])

    @property
    def released(self) -> bool:
        """True if it is part of the base."""
        return bool(self.message["released"])


@attrs.define(kw_only=True)
class Edge:
    """An edge of an order."""

    message: Mapping[str, Any]
    actions: list[Action]
    line: Float = attrs.field(factory=lambda: np.empty((0, 2)), eq=False)
    """f8[k,2] metres: the way along it, without places that follow upon themselves."""

    @property
    def released(self) -> bool:
        """True if it is part of the base."""
        return bool(self.message["released"])

    @property
    def corridor(self) -> Mapping[str, Any] | None:
        """How far the vehicle may leave the line."""
        found: Mapping[str, Any] | None = self.message.get("corridor")
        return found

    @property
    def stands(self) -> bool:
        """True if the vehicle stands during an action of it; here, before it enters the edge."""
        return any(action.blocking in STANDING and not action.ended for action in self.actions)


class Layout(Protocol):
    """Where nodes are."""

    def locate(self, node: Mapping[str, Any]) -> tuple[int, tuple[float, float]] | None:
        """Return vertex and position (metres) of a node, or None if the vehicle cannot be there."""
        ...

    @property
    def maps(self) -> Collection[str]:
        """The maps that exist."""
        ...

    @property
    def has_headings(self) -> bool:
        """True if the vehicle can take the orientation that a node asks for."""
        ...


def asks_for_heading(position: Mapping[str, Any]) -> bool:
    """Tell whether a node asks for an orientation: `theta`, unless any deviation from it is allowed."""
    return "theta" in position and abs(position.get("allowedDeviationTheta", 0.0)) < ANY_THETA


def references(message: Mapping[str, Any]) -> dict[str, str]:
    """Return how errors refer to an order."""
    found = {key: str(message[key]) for key in ("headerId", "orderId", "orderUpdateId") if key in message}
    return {"topic": "order", **found}


def check_structure(order: Mapping[str, Any]) -> None:
    """Check what the schema does not: numbers of nodes and edges, and which of them are released (6.1.1).

    Raises:
        RefusedError: `VALIDATION_FAILURE`.
    """
    nodes, edges = order["nodes"], order["edges"]

    def refuse(description: str) -> None:
        raise RefusedError("VALIDATION_FAILURE", description, references(order))

    if not nodes:
        refuse("the order has no nodes")
    if len(edges) != len(nodes) - 1:
        refuse(f"{len(edges)} edges for {len(nodes)} nodes")
    first = nodes[0]["sequenceId"]
    if first % 2 or (first and not order["orderUpdateId"]):
        refuse(f"the first node has the sequenceId {first}")
    merged = [part for pair in zip(nodes, [*edges, None], strict=True) for part in pair if part is not None]
    for place, part in enumerate(merged):
        if part["sequenceId"] != first + place:
            name = part.get("nodeId", part.get("edgeId"))
            refuse(f"{name!r} has the sequenceId {part['sequenceId']} instead of {first + place}")
    released = [part["released"] for part in merged]
    if not released[0]:
        refuse("the first node is not released")
    base = released.index(False) if False in released else len(released)
    if any(released[base:]):
        refuse(f"sequenceId {first + base} is not released, and one after it is")
    if base % 2 == 0:
        refuse(f"the edge with the sequenceId {first + base - 1} is released without its end node")
    for edge in edges:
        speed = edge.get("maximumSpeed", edge.get("maxSpeed", 1.0))
        if not 0 < speed < float("inf"):
            refuse(f"{edge['edgeId']!r} has the maximum speed {speed}")
    seen: set[str] = set()
    for part in merged:
        for action in part["actions"]:
            if action["actionId"] in seen:
                refuse(f"two actions have the actionId {action['actionId']!r}")
            seen.add(action["actionId"])


def check_fields(order: Mapping[str, Any], names: Names, has_headings: bool) -> None:
    """Check that the order asks for nothing that the vehicles cannot do.

    Raises:
        RefusedError: `UNSUPPORTED_PARAMETER`.
    """
    for part in (order, *order["nodes"], *order["edges"]):
        for field in sorted(names.unsupported & part.keys()):
            found = references(order) | {"parameter": field}
            name = part.get("edgeId", part.get("nodeId", "the order"))
            raise RefusedError("UNSUPPORTED_PARAMETER", f"{name}: {field} is not supported", found, "CRITICAL")
    for node in () if has_headings else order["nodes"]:
        if asks_for_heading(node.get("nodePosition", {})):
            found = references(order) | {"parameter": "theta"}
            what = f"{node['nodeId']}: theta is not supported on a roadmap without headings"
            raise RefusedError("UNSUPPORTED_PARAMETER", what, found, "CRITICAL")


def check_actions(order: Mapping[str, Any], scopes: Mapping[str, Collection[str]]) -> None:
    """Check that the vehicles know all actions.

    Args:
        order: a valid message.
        scopes: of each action that they know: NODE, EDGE, INSTANT.

    Raises:
        RefusedError: `INVALID_ORDER_ACTION`.
    """
    for scope, parts in (("NODE", order["nodes"]), ("EDGE", order["edges"])):
        for action in (action for part in parts for action in part["actions"]):
            if scope not in scopes.get(action["actionType"], ()):
                found = references(order) | {"actionId": action["actionId"], "actionType": action["actionType"]}
                what = (
                    f"the action {action['actionType']!r} does not exist on a{'n' * (scope == 'EDGE')} {scope.lower()}"
                )
                raise RefusedError("INVALID_ORDER_ACTION", what, found)


def read_nodes(order: Mapping[str, Any], layout: Layout, names: Names) -> list[Node]:
    """Find where the nodes of an order are.

    Raises:
        RefusedError: `UNKNOWN_MAP_ID` or `NO_ROUTE_TO_TARGET`.
    """
    found = []
    for node in order["nodes"]:
        position = node.get("nodePosition")
        if position is not None and position["mapId"] not in layout.maps:
            refers = references(order) | {"nodeId": node["nodeId"], "mapId": position["mapId"]}
            known = ", ".join(sorted(layout.maps))
            raise RefusedError("UNKNOWN_MAP_ID", f"no map is called {position['mapId']!r}, only {known}", refers)
        place = layout.locate(node)
        if place is None:
            where = "without a position has an unknown nodeId" if position is None else "is not on the roadmap"
            refers = references(order) | {"nodeId": node["nodeId"]}
            raise RefusedError("NO_ROUTE_TO_TARGET", f"node {node['nodeId']!r} {where}", refers)
        found.append(
            Node(
                message=node,
                vertex=place[0],
                position=place[1],
                any_heading=position is None or not asks_for_heading(position),
                deviation=None if position is None else names.deviation(position),
                actions=[Action.of(action) for action in node["actions"]],
            )
        )
    return found


def read_edges(order: Mapping[str, Any]) -> list[Edge]:
    """Read the edges of a valid order."""
    return [Edge(message=edge, actions=[Action.of(action) for action in edge["actions"]]) for edge in order["edges"]]


def content(order: Mapping[str, Any]) -> dict[str, Any]:
    """Return what an order says, without its header."""
    return {key: value for key, value in order.items() if key not in ("headerId", "timestamp")}


def base_end(nodes: Iterable[Node]) -> int:
    """Return the index of the decision point among nodes of which the first is released."""
    return max(index for index, node in enumerate(nodes) if node.released)
