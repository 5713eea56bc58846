"""Asks a vehicle about corridors and zones; it moves only to a place that the user allows, and back."""

import http.server
import json
import math
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from mrpbench_live.vda5050.check.conversation import Conversation, State
from mrpbench_live.vda5050.check.rules import Report

RULES = {
    "zone_types": "the factsheet lists the zones that the vehicle understands, in supportedZones (6.4)",
    "zone_set": "a zone set that comes on the topic zoneSet is in the state, DISABLED (6.4.2)",
    "zone_duplicate": "a zone set with a known zoneSetId is refused as DUPLICATE_ZONE_SET (6.4.2)",
    "zone_download": "downloadZoneSet fetches a zone set, which is in the state, DISABLED (6.4.2)",
    "zone_enable": "enableZoneSet makes a zone set ENABLED, and any other one of its map DISABLED (6.4.2)",
    "zone_delete": "deleteZoneSet removes a zone set from the state (6.2.3)",
    "blocked_inside": "a vehicle in a BLOCKED zone reports BLOCKED_ZONE_VIOLATION, as long as it is there (6.4.1.1)",
    "blocked_ahead": "the vehicle does not drive into a BLOCKED zone (6.4.1.1)",
    "speed_limit": "the vehicle is no faster than a SPEED_LIMIT zone allows (6.4.1.1)",
    "corridor": "the vehicle takes a corridor, and stays in it or reports OUTSIDE_OF_CORRIDOR (6.1.5)",
    "corridor_unsupported": "a corridor that the factsheet does not list is refused as UNSUPPORTED_PARAMETER (6.1.4.2)",
}
CORRIDOR = "order.edges.corridor"
WIDE_M, HALF_M = 1.0, 0.3
"""Metres of corridors to each side, and half the side of BLOCKED zones."""
AROUND_M = 1.5
"""Metres by which SPEED_LIMIT zones are larger than the way of the vehicle."""
DRIVE_S = 60.0
"""Seconds within which the vehicle has to arrive."""
FASTER, M_S = 1.05, 0.02
"""A vehicle may be faster than a limit by this factor and as many m/s."""


class AreaCheck:
    """Asks one idle vehicle.

    Args:
        vehicle: it.
        report: with the rules above.
        drive: x, y (metres): where it may drive; None: it stays.
    """

    def __init__(self, vehicle: Conversation, report: Report, drive: tuple[float, float] | None) -> None:
        self._with, self._report, self._drive = vehicle, report, drive
        self._made: list[str] = []
        """Zone sets that the vehicle was sent."""

    def run(self) -> None:
        """Ask everything."""
        place, factsheet = self._with.state.get(self._with.names.position), self._with.newest.get("factsheet")
        if place is None or factsheet is None:
            missing = "factsheet came" if factsheet is None else f"{self._with.names.position} is in the state"
            self._skip(RULES, f"no {missing}")
            return
        if self._with.names.zones:
            self._zones(factsheet)
        else:
            self._skip([rule for rule in RULES if not rule.startswith("corridor")], "zones exist since 3.0")
        self._corridors(factsheet)

    def _skip(self, rules: Sequence[str] | dict[str, str], reason: str) -> None:
        for rule in rules:
            self._report.skip(rule, reason)

    # Zones

    def _zones(self, factsheet: State) -> None:
        """Ask about zone sets, and leave the one enabled that was before, or else an empty one."""
        rules = [rule for rule in RULES if not rule.startswith("corridor")]
        supported = factsheet["typeSpecification"].get("supportedZones")
        what = "typeSpecification has no supportedZones"
        self._report.require("zone_types", supported is not None, what, factsheet)
        if not supported:
            self._skip(rules, "the vehicle understands no zones")
            return
        before = next((it["zoneSetId"] for it in self._zone_sets() if it["zoneSetStatus"] == "ENABLED"), None)
        empty = self._zone_set([])
        self._with.publish("zoneSet", empty)
        name = empty["zoneSet"]["zoneSetId"]
        self._has("zone_set", name, "DISABLED")
        self._with.publish("zoneSet", empty)
        self._error("zone_duplicate", "DUPLICATE_ZONE_SET")
        self._download(factsheet)
        if "BLOCKED" in supported:
            self._blocked(name)
        else:
            self._skip(("blocked_inside", "blocked_ahead", "zone_enable"), "the vehicle knows no BLOCKED zones")
        if "SPEED_LIMIT" in supported:
            self._speed_limit(factsheet)
        else:
            self._skip(("speed_limit",), "the vehicle knows no SPEED_LIMIT zones")
        self._act("enableZoneSet", before or name)
        left = [it for it in self._made if before or it != name]
        for it in left:
            self._act("deleteZoneSet", it)
        gone = self._with.wait("state", lambda state: not {it["zoneSetId"] for it in _sets(state)} & set(left))
        self._report.require("zone_delete", gone, "deleted zone sets are still in the state", self._with.state)

    def _blocked(self, other: str) -> None:
        """Ask a vehicle in a zone, and, if it may drive, one whose way ends in a zone."""
        x, y = self._here
        zone = self._send_zone("BLOCKED", (x, y), (x, y), HALF_M)
        self._act("enableZoneSet", other)
        self._act("enableZoneSet", zone)
        if self._has("zone_enable", zone, "ENABLED"):
            enabled = [it["zoneSetId"] for it in self._zone_sets() if it["zoneSetStatus"] == "ENABLED"]
            mine = [it for it in enabled if it in self._made]
            self._report.require("zone_enable", mine == [zone], f"enabled: {', '.join(mine)}", self._with.state)
        self._error("blocked_inside", "BLOCKED_ZONE_VIOLATION")
        self._act("enableZoneSet", other)
        over = self._with.wait("state", lambda state: "BLOCKED_ZONE_VIOLATION" not in _errors(state))
        self._report.require("blocked_inside", over, "the error stays without the zone", self._with.state)
        if self._drive is None:
            self._skip(("blocked_ahead",), "the vehicle may not move: --drive X,Y")
            return
        self._act("enableZoneSet", self._send_zone("BLOCKED", self._drive, self._drive, HALF_M))
        states = self._go(self._drive)
        inside = [it for it in states if _is_in(it[self._with.names.position], self._drive, HALF_M)]
        broken = inside or [it for it in states if "BLOCKED_ZONE_VIOLATION" in _errors(it)]
        first = broken[0] if broken else None
        self._report.require("blocked_ahead", not broken, "it came into the zone around the place", first)
        self._stop()
        self._act("enableZoneSet", other)
        self._go((x, y))

    def _speed_limit(self, factsheet: State) -> None:
        if self._drive is None:
            self._skip(("speed_limit",), "the vehicle may not move: --drive X,Y")
            return
        limit, here = factsheet["physicalParameters"]["maximumSpeed"] / 2, self._here
        self._act("enableZoneSet", self._send_zone("SPEED_LIMIT", here, self._drive, AROUND_M, maximumSpeed=limit))
        states = self._go(self._drive)
        speeds = [(math.hypot(it["velocity"].get("vx", 0.0), it["velocity"].get("vy", 0.0)), it) for it in states]
        fastest, state = max(speeds, key=lambda it: it[0], default=(0.0, None))
        if not self._is_at(self._drive) or fastest == 0.0:
            self._skip(("speed_limit",), "the vehicle did not drive to the place, or says no velocity")
        else:
            what = f"{fastest:.2f} m/s instead of {limit:.2f} m/s"
            self._report.require("speed_limit", fastest <= FASTER * limit + M_S, what, state)
        self._stop()
        self._go(here)

    def _download(self, factsheet: State) -> None:
        actions = factsheet["protocolFeatures"].get("mobileRobotActions", ())
        if "downloadZoneSet" not in {it["actionType"] for it in actions}:
            self._skip(("zone_download",), "the factsheet does not list downloadZoneSet, which is optional")
            return
        message = self._zone_set([])
        name = message["zoneSet"]["zoneSetId"]
        with served(self._with.address, json.dumps(message).encode()) as link:
            key = self._act("downloadZoneSet", name, zoneSetDownloadLink=link)
        status = self._with.status(self._with.state, key)
        what = f"downloadZoneSet of {link} has the status {status}"
        if self._report.require("zone_download", status == "FINISHED", what, self._with.state):
            self._has("zone_download", name, "DISABLED")

    def _act(self, kind: str, zone_set: str, **parameters: str) -> str:
        """Do something with a zone set, until that has succeeded or failed; return the id of the action."""
        key = self._with.act(kind, zoneSetId=zone_set, **parameters)
        self._with.wait("state", lambda state: self._with.status(state, key) in ("FINISHED", "FAILED"))
        return key

    def _send_zone(
        self, kind: str, one: tuple[float, float], other: tuple[float, float], more: float, **parameters: float
    ) -> str:
        """Send a zone set with one rectangle around two places; return its id."""
        low, high = ([end(pair) for pair in zip(one, other, strict=True)] for end in (min, max))
        x = low[0] - more, high[0] + more
        y = low[1] - more, high[1] + more
        corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
        vertices = [{"x": x, "y": y} for x, y in corners]
        message = self._zone_set([{"zoneId": "zone", "zoneType": kind, "vertices": vertices, **parameters}])
        self._with.publish("zoneSet", message)
        name = str(message["zoneSet"]["zoneSetId"])
        self._has("zone_set", name, "DISABLED")
        return name

    def _zone_set(self, zones: list[dict[str, Any]]) -> dict[str, Any]:
        name, map_id = self._with.new_id(), self._with.state[self._with.names.position]["mapId"]
        self._made.append(name)
        header = self._with.header("zoneSet")
        return {**header, "zoneSet": {"mapId": map_id, "zoneSetId": name, "zones": zones}}

    def _zone_sets(self) -> Sequence[State]:
        return _sets(self._with.state)

    def _has(self, rule: str, name: str, status: str) -> bool:
        """Require that a zone set is in the state with a status."""
        found = self._with.wait(
            "state", lambda state: (name, status) in [(it["zoneSetId"], it["zoneSetStatus"]) for it in _sets(state)]
        )
        return self._report.require(rule, found, f"{name} is not {status} in zoneSets", self._with.state)

    def _error(self, rule: str, kind: str) -> None:
        """Require that an error is in the state."""
        found = self._with.wait("state", lambda state: kind in _errors(state))
        self._report.require(rule, found, f"no error {kind}", self._with.state)

    # Corridors

    def _corridors(self, factsheet: State) -> None:
        listed = factsheet["protocolFeatures"].get("optionalParameters", ())
        supported = any(it["parameter"] == CORRIDOR for it in listed)
        rule, others = ("corridor", "corridor_unsupported")[:: 1 if supported else -1]
        self._skip((others,), f"the factsheet {'lists' if supported else 'does not list'} {CORRIDOR}")
        if self._drive is None:
            self._skip((rule,), "the vehicle may not move: --drive X,Y")
            return
        here, there = self._here, self._drive
        states = self._go(there, corridor={"leftWidth": WIDE_M, "rightWidth": WIDE_M})  # of its kinematic center
        if not supported:
            kind = self._with.names.error("UNSUPPORTED_PARAMETER", "CRITICAL")[0]
            found = any(kind in _errors(it) for it in states)
            self._report.require(rule, found, f"no error {kind}", self._with.state)
        else:
            arrived = self._is_at(there)
            self._report.require(rule, arrived, "the vehicle did not come to the end of the edge", self._with.state)
            kind = self._with.names.error("OUTSIDE_OF_CORRIDOR", "CRITICAL")[0]
            position = self._with.names.position
            out = [it for it in states if _off(it[position], here, there) > WIDE_M and kind not in _errors(it)]
            self._report.require(rule, not out, f"outside without an error {kind}", out[0] if out else None)
        self._stop()
        self._go(here)

    # Driving

    @property
    def _here(self) -> tuple[float, float]:
        place = self._with.state[self._with.names.position]
        return float(place["x"]), float(place["y"])

    def _is_at(self, there: tuple[float, float]) -> bool:
        return math.dist(self._here, there) <= HALF_M

    def _go(self, there: tuple[float, float], **edge: Any) -> list[State]:
        """Order the vehicle to a place, and wait until it stands; return the states with a position meanwhile."""
        vehicle, states = self._with, list[State]()
        order = vehicle.order_to(there, **edge)
        vehicle.states = states
        vehicle.publish("order", order)
        vehicle.is_held(order, 0)
        begins = vehicle.wait("state", lambda state: bool(state["driving"]))
        while begins and vehicle.wait("state", lambda state: not state["driving"], DRIVE_S):
            begins = vehicle.wait("state", lambda state: bool(state["driving"]))
        vehicle.states = None
        return [it for it in states if vehicle.names.position in it and it.get("velocity") is not None]

    def _stop(self) -> None:
        """Cancel an order that is not over."""
        if self._with.state["nodeStates"]:
            key = self._with.act("cancelOrder")
            self._with.wait("state", lambda state: self._with.status(state, key) in ("FINISHED", "FAILED"))


def _sets(state: State) -> Sequence[State]:
    found: Sequence[State] = state.get("zoneSets", ())
    return found


def _errors(state: State) -> set[str]:
    return {str(error["errorType"]) for error in state["errors"]}


def _is_in(place: State, centre: tuple[float, float], half: float) -> bool:
    return max(abs(float(place["x"]) - centre[0]), abs(float(place["y"]) - centre[1])) < half


def _off(place: State, tail: tuple[float, float], head: tuple[float, float]) -> float:
    """Metres of a place from the line through two others."""
    along = head[0] - tail[0], head[1] - tail[1]
    aside = along[0] * (float(place["y"]) - tail[1]) - along[1] * (float(place["x"]) - tail[0])
    return abs(aside) / math.hypot(*along)


@contextmanager
def served(address: str, content: bytes) -> Iterator[str]:
    """Serve a file on an address of this machine; yield its link."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    server = http.server.ThreadingHTTPServer((address, 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://{address}:{server.server_port}/zones.json"
    finally:
        server.shutdown()
        server.server_close()
