"""One vehicle: which order it has, how far it has come with it, and which actions it performs.

It drives on the lines of the roadmap (VIRTUAL_LINE_GUIDED), so it stops at the next node at which it can when an order
is cancelled or when it is paused (6.1.3).
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mrpbench_live.vda5050 import orders
from mrpbench_live.vda5050.actions import STANDING, Action, ActionQueue
from mrpbench_live.vda5050.battery import Battery
from mrpbench_live.vda5050.bounds import Bounds
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.corridors import check_corridors
from mrpbench_live.vda5050.errors import UNTIL_NEXT_ORDER, UNTIL_NEXT_ZONE_SET, Errors
from mrpbench_live.vda5050.names import Names
from mrpbench_live.vda5050.orders import Edge, Node, RefusedError
from mrpbench_live.vda5050.scopes import scopes_of
from mrpbench_live.vda5050.track import Track, distance

START_RANGE = 0.5
"""Metres from the vehicle at which the first node of an order is in range, unless the order says more."""
NEW_BASE = 3.0
"""Metres before the end of the base at which a vehicle asks for more, if there is a horizon."""
AT_ONCE = "startCharging", "stopCharging"
"""Actions that take no time."""


class Vehicle:
    """A vehicle.

    Args:
        track: its path.
        names: of the version that it speaks.
        battery: its model.
        action_s: simulated seconds that actions like `pick` take.
        note: called with the kind of an event and one line about it.
    """

    def __init__(
        self, track: Track, names: Names, battery: Battery, action_s: float, note: Callable[[str, str], None]
    ) -> None:
        self._track, self._names, self._battery, self._action_s, self._note = track, names, battery, action_s, note
        self.here = Here(now=0.0, pose=(0.0, 0.0, 0.0), level=0, driving=False, gave_up=False)
        self.order: Mapping[str, Any] | None = None
        """The newest message of the order."""
        self.nodes: list[Node] = []
        """Those that are not traversed."""
        self.edges: list[Edge] = []
        """Those that are not left; the first one leads to the first node."""
        self.last_node, self.last_sequence = "", 0
        self._decision: Node | None = None
        """The last node of the base."""
        self.actions: dict[str, Action] = {}
        """Of the order, by id."""
        self.instant: dict[str, Action] = {}
        self.errors = Errors(names, note, self._change)
        self.paused, self.charging, self.new_base = False, False, False
        self.load: str | None = None
        self.charge = battery.initial
        self.available = True
        self.wants_factsheet = False
        self.pause: Action | None = None
        """The instant action that ends when the paused vehicle stands."""
        self._cancel: Action | None = None
        self._cancelled = self._has_horizon = self._restless = False
        self._bounds = Bounds(track, self.errors)
        self.zones = track.zones
        self.queue = ActionQueue()
        """The actions of the order that were triggered."""
        self.changed = True
        """Something has happened of which a state must tell."""

    def _change(self) -> None:
        self.changed = True

    # Orders

    def take_order(self, message: Any, fault: str | None) -> None:
        """Accept an order or an update, or refuse it; `fault`: what is wrong with the message by its schema."""
        try:
            if fault is not None:
                refers = orders.references(message) if isinstance(message, Mapping) else {"topic": "order"}
                raise RefusedError("VALIDATION_FAILURE", fault, refers)
            orders.check_structure(message)
            self._accept(message)
        except RefusedError as refusal:
            self.errors.refuse(refusal, UNTIL_NEXT_ORDER)

    def _accept(self, message: Mapping[str, Any]) -> None:
        same = self.order is not None and message["orderId"] == self.order["orderId"]
        if same and self._is_repetition(message):
            return
        refers = orders.references(message)
        if not self.available:
            raise RefusedError("MOBILE_ROBOT_NOT_AVAILABLE", "the vehicle cannot drive any more", refers)
        if not same and not self.idle:
            assert self.order is not None
            raise RefusedError("OTHER_ORDER_ACTIVE", f"the order {self.order['orderId']!r} is active", refers)
        if not same:
            self._check_start(message)
        orders.check_fields(message, self._names, self._track.has_headings)
        orders.check_actions(message, scopes_of(self._names))
        check_corridors(message, self._track.footprint)
        nodes, edges = orders.read_nodes(message, self._track, self._names), orders.read_edges(message)
        if same:
            self._update(message, nodes, edges)
        else:
            self._begin(message, nodes, edges)
        self.order = message
        self.errors.end(UNTIL_NEXT_ORDER)
        self.changed = True
        self._look_ahead()
        self._drive()  # from this control period on
        self._note("order_accepted", f"{message['orderId']} {message['orderUpdateId']}")

    def _is_repetition(self, message: Mapping[str, Any]) -> bool:
        """Tell whether the vehicle has this message already; refuse what is older, differs, or follows a cancel."""
        assert self.order is not None
        refers, update, known = orders.references(message), message["orderUpdateId"], self.order["orderUpdateId"]
        if update < known:
            raise RefusedError("OUTDATED_ORDER_UPDATE", f"orderUpdateId {update} after {known}", refers)
        if update == known:
            if orders.content(message) == orders.content(self.order):
                return True
            raise RefusedError("SAME_ORDER_UPDATE_ID", f"orderUpdateId {known} is known with other content", refers)
        if self._cancelled or self._cancel is not None:
            raise RefusedError("ORDER_UPDATE_FOLLOWING_CANCEL", "the order is cancelled", refers)
        return False

    def _begin(self, message: Mapping[str, Any], nodes: list[Node], edges: list[Edge]) -> None:
        """Take over a new order."""
        first = nodes[0]
        ways = self._ways(message, self._track.end, nodes[1:])
        first.mark = self._track.length
        self._bounds.resume()
        self._lay(edges, ways)
        self._track.replace(first.mark, nodes[1:], ways)
        self.nodes, self.edges, self.actions = nodes[1:], edges, {}
        if not self._names.has_instant_states:
            self.instant = {key: action for key, action in self.instant.items() if not action.ended}
        self._register(nodes, edges)
        self._cancelled, self._cancel = False, None
        self._decision = nodes[orders.base_end(nodes)]
        self.last_node, self.last_sequence = first.id, first.sequence
        self._traversed(first, edges)

    def _update(self, message: Mapping[str, Any], nodes: list[Node], edges: list[Edge]) -> None:
        """Continue the order from its decision point; the horizon is replaced."""
        refers, decision, first = orders.references(message), self._decision, nodes[0]
        assert decision is not None
        if (first.id, first.sequence) != (decision.id, decision.sequence):
            what = f"the update begins with {first.id!r}, {first.sequence}, and the base ends with {decision.id!r}, "
            raise RefusedError("NO_STITCHING", f"{what}{decision.sequence}", refers | {"nodeId": first.id})
        ways = self._ways(message, self._track.end_after(decision.mark), nodes[1:])
        self._lay(edges, ways)
        self._track.replace(decision.mark, nodes[1:], ways)
        left: list[Node | Edge] = [*self.nodes, *self.edges]
        horizon = {action.id for part in left if not part.released for action in part.actions}
        self.actions = {key: action for key, action in self.actions.items() if key not in horizon}
        self.nodes = [node for node in self.nodes if node.released] + nodes[1:]
        self.edges = [edge for edge in self.edges if edge.released] + edges
        self._register(nodes[1:], edges)
        self._decision = nodes[orders.base_end(nodes)] if orders.base_end(nodes) else decision
        if decision not in self.nodes and edges and not self.queue.standing:
            self._enter(edges[0])

    def _ways(self, message: Mapping[str, Any], start: int, nodes: list[Node]) -> list[tuple[int, ...]]:
        ways = self._track.continue_by(start, nodes)
        if isinstance(ways, Node):
            refers = orders.references(message) | {"nodeId": ways.id}
            raise RefusedError("NO_ROUTE_TO_TARGET", f"no way leads to node {ways.id!r}", refers)
        return ways

    def _check_start(self, message: Mapping[str, Any]) -> None:
        """Check that a new order begins where the vehicle is; a map that does not exist is found later.

        Raises:
            RefusedError: it begins elsewhere, or is an update of an order that the vehicle does not have.
        """
        refers, node = orders.references(message), message["nodes"][0]
        if message["orderUpdateId"]:
            raise RefusedError("VALIDATION_FAILURE", "a new order begins with the orderUpdateId 0", refers)
        position = node.get("nodePosition")
        if position is None:
            place = self._track.locate(node)
            away, within = (0.0 if place is None else distance(self.here.pose, place[1])), START_RANGE
        elif position["mapId"] in self._track.maps:
            away = distance(self.here.pose, (position["x"], position["y"]))
            away = away if self._track.maps[self.here.level] == position["mapId"] else float("inf")
            within = max(START_RANGE, self._names.deviation(position) or 0.0)
        else:
            return
        if away > within:
            what = f"node {node['nodeId']!r} is {away:.2f} m away"
            raise RefusedError("START_NODE_OUT_OF_RANGE", what, refers | {"nodeId": node["nodeId"]})

    def _register(self, nodes: list[Node], edges: list[Edge]) -> None:
        parts: list[Node | Edge] = [*nodes, *edges]
        self.actions |= {action.id: action for part in parts for action in part.actions}

    @property
    def idle(self) -> bool:
        """True if the vehicle can take a new order (6.6.8)."""
        busy = self.nodes or self.edges or self._cancel is not None
        return not busy and all(action.ended for action in self.actions.values())

    # Time

    @property
    def restless(self) -> bool:
        """True if something may happen to the vehicle although it neither passes a node nor begins or ends to drive."""
        return self.changed or self._restless

    def advance(self, here: Here) -> None:
        """Go on to another time: traverse nodes, perform actions, and decide how far the vehicle may drive."""
        before, self.here = self.here, here
        self._drain(before, here)
        if here.driving != before.driving:
            self.changed = True
        if here.gave_up and self.available:
            self._break_down()
        while self.nodes and self.nodes[0].mark <= self._track.passed and self._may_traverse(self.nodes[0]):
            self._traverse(self.nodes.pop(0))
        self._bounds.watch(here, self._edge)
        self._perform(here)
        self._finish(here)
        self._drive()
        waits = self.pause is not None and not self.pause.ended
        busy = bool(self.queue) or self._cancel is not None or self._has_horizon
        edge = self._edge
        self._restless = waits or busy or bool(self.zones) or (edge is not None and edge.corridor is not None)

    def _may_traverse(self, node: Node) -> bool:
        """A vehicle that waits at a node counts it only once; one that is cancelled stops where its path ends."""
        return node.released and (self._cancel is None or node.mark <= self._track.length)

    def _traverse(self, node: Node) -> None:
        for action in self.edges.pop(0).actions if self.edges else ():
            if not action.ended:
                action.status = "FINISHED" if action.begun else "FAILED"
        away = distance(self.here.pose, node.position)
        self.last_node, self.last_sequence, self.changed = node.id, node.sequence, True
        self._note("node_traversed", f"{node.id} {node.sequence} {away:.3f} m from it")
        if node.deviation is not None and away > node.deviation:
            self._note("node_deviation", f"{node.id} {node.sequence}: {away:.3f} m instead of {node.deviation:g} m")
        if self._cancel is None:
            self._traversed(node, self.edges)

    def _traversed(self, node: Node, edges: list[Edge]) -> None:
        """Trigger the actions of a node, and those of the edge after it."""
        self.queue.trigger(node.actions)
        if edges and not self.queue.standing:
            self._enter(edges[0])

    def _enter(self, edge: Edge) -> None:
        if edge.released:
            self.queue.trigger(edge.actions)

    def _perform(self, here: Here) -> None:
        """Begin and end actions."""
        for action in self.queue.running():
            if here.now >= action.until - 1e-9:
                self._end(action)
                self.changed = True
        standing = self.queue.standing
        while begun := self.queue.startable(not here.driving):
            for action in begun:
                action.begun, action.status, self.changed = True, "RUNNING", True
                if action.type != "waitForTrigger":
                    action.until = here.now + (0.0 if action.type in AT_ONCE else self._action_s)
                if action.type in AT_ONCE:
                    self._end(action)
        if standing and not self.queue.standing and self.edges and self.edges[0].released and self._cancel is None:
            self._enter(self.edges[0])

    def _end(self, action: Action) -> None:
        """End an action of the order."""
        action.status = "FINISHED"
        if action.type == "pick":
            if self.load is not None:
                action.status, action.result = "FAILED", "the vehicle has a load"
            else:
                self.load = str(action.parameters.get("loadId", action.id))
        elif action.type == "drop":
            if self.load is None:
                action.status, action.result = "FAILED", "the vehicle has no load"
            self.load = None
        elif action.type in ("startCharging", "stopCharging"):
            self.charging = action.type == "startCharging"
        self._note("action_ended", f"{action.type} {action.id} {action.status}")

    def _finish(self, here: Here) -> None:
        """End a pause, a cancellation or an order, if the vehicle stands."""
        if here.driving:
            return
        if self.pause is not None and not self.pause.ended:
            self.pause.status, self.changed = "FINISHED", True
        if self._cancel is not None and self._track.passed >= self._track.length:
            self.nodes, self.edges, self._cancelled = [], [], True
            self._bounds.resume()
            self._cancel.status, self._cancel, self.changed = "FINISHED", None, True
            self._note("order_cancelled", str(self.order and self.order["orderId"]))

    def _drive(self) -> None:
        """Let the vehicle drive to the end of its base, or to where it has to stand before."""
        limit, speed = self._track.passed, float("inf")
        if self._cancel is not None:
            limit = self._track.length
        elif not self._bounds.halted and not self.paused and not self.queue.standing and not self.charging:
            for node, edge in zip(self.nodes, self.edges, strict=False):
                if not node.released or edge.stands:
                    break
                limit = node.mark
                if any(action.blocking in STANDING and not action.ended for action in node.actions):
                    break
        if self._cancel is None:
            limit = self._bounds.limit(limit)
        if self.edges:
            speed = float(self.edges[0].message.get(self._names.maximum_speed, speed))
        if self.zones.limits_speed:
            speed = min(speed, self.zones.speed(self.here, self._track.ahead))
        self._track.allow(limit, speed)
        self._has_horizon = bool(self.nodes) and not self.nodes[-1].released
        asks = self._cancel is None and self._has_horizon and self._base_is_short()
        if asks != self.new_base:
            self.new_base, self.changed = asks, True

    # Where it may be

    @property
    def _edge(self) -> Edge | None:
        """The edge on which the vehicle is, None while it is cancelled: then it only stops."""
        on_edge = self.edges and self.edges[0].released and self._cancel is None
        return self.edges[0] if on_edge else None

    def take_zones(self, message: Any, fault: str | None) -> str | None:
        """Keep a zone set, or refuse it and return why; `fault`: what is wrong with the message by its schema."""
        try:
            if fault is not None:
                raise RefusedError("VALIDATION_FAILURE", fault, {"topic": "zoneSet"})
            self.zones.add(message)
        except RefusedError as refusal:
            self.errors.refuse(refusal, UNTIL_NEXT_ZONE_SET)
            return str(refusal)
        self.zones_changed()
        self._note("zone_set", str(message["zoneSet"]["zoneSetId"]))
        return None

    def known_zone_set(self, name: str) -> str | None:
        """Report that there is a zone set of a name already, and return that; None: there is none."""
        try:
            self.zones.check_new(name)
        except RefusedError as refusal:
            self.errors.refuse(refusal, UNTIL_NEXT_ZONE_SET)
            return str(refusal)
        return None

    def zones_changed(self) -> None:
        """Note that zone sets were added, enabled or deleted, which ends errors about them."""
        self.errors.end(UNTIL_NEXT_ZONE_SET)
        self.changed = True
        self._look_ahead()
        self._drive()

    def _look_ahead(self) -> None:
        self._bounds.look_ahead(() if self._cancel is not None else self.nodes)

    def _lay(self, edges: list[Edge], ways: Sequence[tuple[int, ...]]) -> None:
        """Note the lines of edges that have corridors."""
        for edge, way in zip(edges, ways, strict=True):
            if edge.corridor is not None:
                edge.line = self._track.line(way)

    def _base_is_short(self) -> bool:
        left = [node for node in self.nodes if node.released]
        return sum(1 for _ in left) <= 1 and (not left or distance(self.here.pose, left[-1].position) <= NEW_BASE)

    def _drain(self, before: Here, here: Here) -> None:
        metres = distance(here.pose, before.pose[:2])
        seconds = max(0.0, here.now - before.now)
        if seconds:
            then, now = ((velocity[0], velocity[2]) for velocity in (before.velocity, here.velocity))
            self.charge = self._battery.after(self.charge, seconds, metres, then, now, self.charging)

    # Ends

    def cancel(self, action: Action) -> None:
        """Cancel the order; `action` ends when the vehicle stands."""
        self._cancel = action
        self._drop_actions("cancelled")
        self._track.shorten(self._track.released)

    @property
    def cancellable(self) -> bool:
        """True if there is an order that is neither done nor cancelled."""
        return self.order is not None and not self.idle and self._cancel is None

    def _drop_actions(self, result: str) -> None:
        self.queue.clear()
        for action in self.actions.values():
            if not action.ended:
                action.status, action.result = "FAILED", result

    def _break_down(self) -> None:
        """The vehicle cannot drive any more: it is out of the fleet control's hands, and has no order (6.6.6)."""
        self.available = False
        node = self.nodes[0].id if self.nodes else self.last_node
        refers = {"nodeId": node}
        self.errors.report("NODE_UNREACHABLE", "CRITICAL", "the vehicle is stuck and gave up", refers, UNTIL_NEXT_ORDER)
        self._drop_actions("the vehicle gave up")
        self._track.shorten(self._track.released)
        self._cancel, self.nodes, self.edges = None, [], []
