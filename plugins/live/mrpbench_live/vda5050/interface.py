"""The interface `vda5050`: every robot is a vehicle of its own for an outside fleet control."""

import json
import math
from collections.abc import Sequence
from typing import Any, Literal

import attrs
import msgspec
import numpy as np
from attrs.validators import ge, gt

from mrpbench_core.api import Event, option
from mrpbench_core.files.printing import printable
from mrpbench_live.fleet.interface import Connection, Interface
from mrpbench_live.fleet.paths import FleetPaths, FleetState
from mrpbench_live.fleet.site import Site
from mrpbench_live.fleet.transports import Transport
from mrpbench_live.vda5050.battery import Battery
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.instant import InstantActions
from mrpbench_live.vda5050.messages import Headers, factsheet_of, position_of, read, state_of, velocity_of
from mrpbench_live.vda5050.names import VERSIONS, Names
from mrpbench_live.vda5050.schemas import validator
from mrpbench_live.vda5050.track import Track
from mrpbench_live.vda5050.transports import TRANSPORTS, transport_message
from mrpbench_live.vda5050.vehicle import Vehicle
from mrpbench_live.vda5050.wire import Broker, Client, Wire
from mrpbench_live.vda5050.wire_faults import FaultyWire, WireFaults

LEAST_INTERVAL = 0.1
"""Simulated seconds between two states of a vehicle at least."""
CONNECTING_S = 30.0
"""Seconds within which all vehicles have to be connected."""
LONGEST = 300
"""Characters of what the recording says of a message, at most."""


@attrs.frozen(kw_only=True)
class Vda5050(Interface):
    """Vehicles of VDA 5050 on a broker of MQTT."""

    url: str = option(
        "mqtt://127.0.0.1:1883", help="the broker; a user before the host, its password in the environment"
    )
    version: Literal["2.1", "3.0"] = option("3.0", help="of VDA 5050")
    topics: str = option("", help="what topics begin with; empty: `uagv/v2` in 2.1, `vda5050/v3` in 3.0")
    manufacturer: str = option("mrpbench", help="second last part of topics but one; the serial number is robot_0, …")
    state_interval: float = option(1.0, help="most simulated time between two states", unit="s", validator=gt(0))
    visualization_interval: float = option(
        0.0, help="simulated time between two messages on `visualization`; 0: there are none", unit="s", validator=ge(0)
    )
    action_time: float = option(5.0, help="simulated time that actions like `pick` take", unit="s", validator=ge(0))
    battery: Battery = option(Battery(), help="model of the batteries")
    faults: WireFaults = option(WireFaults(), help="of the wire")

    def connect(self, site: Site, paths: FleetPaths) -> "VdaFleet":
        """Connect all vehicles.

        Raises:
            InputError: there is no broker, or a library is missing.
        """
        return VdaFleet(self, site, paths)


class VdaFleet(Connection):
    """The vehicles of one run."""

    def __init__(self, recipe: Vda5050, site: Site, paths: FleetPaths) -> None:
        self._wire = Wire(Broker.of(recipe.url))
        self._paths, self._maps, self._now = paths, site.levels, 0.0
        self._cut_for = recipe.faults.cut_for
        self._events: list[Event] = []
        self.faulty = FaultyWire(recipe.faults, self._wire)
        self.due = np.zeros(len(site.fleet))
        """f8[n] simulated seconds at which a message of each vehicle is due."""
        self.restless = np.ones(len(site.fleet), bool)
        """bool[n]: something may happen although the vehicle neither passes a node nor begins or ends to drive."""
        self._facts = np.full((3, len(site.fleet)), -1)
        """i8[3,n] what the vehicles knew last: moves that they have made, whether they drive, whether they gave up."""
        self._members = [_Member(self, self._wire, recipe, site, paths, robot) for robot in range(len(site.fleet))]
        for member in self._members:
            self._wire.add(member.client)
            self._wire.serve(0.0)
        self._wire.meet(CONNECTING_S)

    def note(self, robot: int, kind: str, detail: str) -> None:
        """Add an event to the recording."""
        self._events.append(Event(stamp=self._now, kind=kind, robot=robot, detail=printable(detail)[:LONGEST]))

    def exchange(self, state: FleetState, due: float) -> Sequence[Event]:
        """Advance all vehicles, send what they have to say, and take in what waits or comes until `due`."""
        self._now = now = state.now
        if self.faulty.advance(now):
            self.note(-1, "connections_cut", f"for {self._cut_for:g} s")
        facts = np.stack([self._paths.passed, state.driving, state.gave_up])
        other = (facts != self._facts).any(axis=0)
        self._facts = facts
        for robot in np.flatnonzero(other | self.restless | (now >= self.due)).tolist():
            x, y, yaw = state.pose[robot].tolist()
            vx, vy, omega = state.velocity[robot].tolist()
            here = Here(
                now=state.now,
                pose=(x, y, yaw),
                level=int(state.level[robot]),
                driving=bool(state.driving[robot]),
                gave_up=bool(state.gave_up[robot]),
                velocity=(vx, vy, omega),
            )
            self._members[robot].advance(here, now)
        self._wire.serve(due)
        events, self._events = self._events, []
        return events

    def offer(self, transports: Sequence[Transport]) -> None:
        """Publish transports, which VDA 5050 leaves to fleet controls: each as `transport_message` has it."""
        for transport in transports:
            message = transport_message(transport, self._maps)
            self._members[0].client.publish(TRANSPORTS, json.dumps(message).encode(), qos=1)

    def close(self) -> None:
        """Say that all vehicles are offline."""
        for member in self._members:
            member.leave()
        self._wire.close()


class _Member:
    """One vehicle with its connection."""

    def __init__(self, fleet: VdaFleet, wire: Wire, recipe: Vda5050, site: Site, paths: FleetPaths, robot: int) -> None:
        self._names: Names = VERSIONS[recipe.version]
        self._fleet, self._index = fleet, robot
        self._maps, self._robot, self._headings = site.levels, site.fleet.robots[robot], site.has_headings
        serial = site.robots[robot]
        self._topic = f"{recipe.topics or self._names.topics}/{recipe.manufacturer}/{serial}/"
        self._headers = Headers(self._names.version, recipe.manufacturer, serial)
        self._intervals = LEAST_INTERVAL, recipe.state_interval, recipe.visualization_interval
        self._order_fault = validator(recipe.version, "order")
        self._actions_fault = validator(recipe.version, "instantActions")
        self._zones_fault = validator(recipe.version, "zoneSet") if self._names.zones else _no_zones

        def note(kind: str, detail: str) -> None:
            fleet.note(robot, kind, detail)

        self._note = note
        track = Track(site, paths, robot)
        self._vehicle = Vehicle(track, self._names, recipe.battery, recipe.action_time, note)
        self._vehicle.last_node = track.name(track.end)
        self._instant = InstantActions(self._vehicle, track, self._names, note, self._zones_fault)
        self._phase = recipe.state_interval * (robot % 97) / 97  # not all at once, also after what all meet at one time
        self._state_at = self._phase
        self._visualization_at = 0.0 if recipe.visualization_interval else float("inf")
        self._not_before = 0.0
        will = {**self._headers.next("connection"), "connectionState": self._names.connection_broken}
        self.client = Client(
            wire,
            f"{recipe.manufacturer}-{serial}",
            (f"{self._topic}connection", json.dumps(will).encode()),
            tuple(self._topic + it for it in ("order", "instantActions", *(["zoneSet"] if self._names.zones else []))),
            self._online,
            lambda topic, payload: fleet.faulty.carry(lambda: self._take(topic, payload)),
        )
        self._carry = fleet.faulty.carry

    def advance(self, here: Here, now: float) -> None:
        """Go on, and send what is due at `now`."""
        vehicle = self._vehicle
        self._instant.advance()
        vehicle.advance(here)
        if vehicle.wants_factsheet:
            vehicle.wants_factsheet = False
            self._send_factsheet()
        if (vehicle.changed and now >= self._not_before) or now >= self._state_at:
            self._send_state(now)
        if now >= self._visualization_at:
            self._visualization_at = now + self._intervals[2] - 1e-9
            self._send("visualization", self._visualization())
        self._fleet.due[self._index] = min(self._state_at, self._visualization_at)
        self._fleet.restless[self._index] = vehicle.restless or self._instant.restless

    def leave(self) -> None:
        """Say that the vehicle is offline."""
        self._send("connection", {"connectionState": "OFFLINE"}, qos=1, retain=True)

    def _online(self) -> None:
        self._send("connection", {"connectionState": "ONLINE"}, qos=1, retain=True)
        self._send_factsheet()
        self._vehicle.changed = self._fleet.restless[self._index] = True
        self._note("connection", "ONLINE")

    def _send_state(self, now: float) -> None:
        if self._send("state", state_of(self._vehicle, self._maps, self._names)):
            self._vehicle.changed = False
        interval = self._intervals[1]
        self._state_at = self._phase + interval * (math.floor((now - self._phase) / interval + 1e-6) + 1) - 1e-9
        self._not_before = now + LEAST_INTERVAL - 1e-9  # control periods do not add up exactly

    def _send_factsheet(self) -> None:
        self._send("factsheet", factsheet_of(self._robot, self._names, self._intervals, self._headings), retain=True)

    def _visualization(self) -> dict[str, Any]:
        found: dict[str, Any] = {
            self._names.position: position_of(self._vehicle, self._maps, self._names),
            "velocity": velocity_of(self._vehicle),
        }
        if self._names.has_instant_states:
            found["referenceStateHeaderId"] = self._headers.last("state")
        return found

    def _send(self, topic: str, body: dict[str, Any], qos: int = 0, retain: bool = False) -> bool:
        if not self.client.connected:
            return False
        payload = msgspec.json.encode({**self._headers.next(topic), **body})  # a tenth of the time of json
        if retain:
            return self.client.publish(self._topic + topic, payload, qos, retain)
        self._carry(lambda: self.client.publish(self._topic + topic, payload, qos))
        return True

    def _take(self, topic: str, payload: bytes) -> None:
        """Take in a message of the fleet control, whatever it is."""
        message, fault = read(payload)
        kind = topic.rpartition("/")[2]
        self._fleet.restless[self._index] = True
        if kind == "order":
            self._vehicle.take_order(message, fault or self._order_fault(message))
        elif kind == "instantActions":
            self._instant.take(message, fault or self._actions_fault(message))
        elif kind == "zoneSet":
            self._vehicle.take_zones(message, fault or self._zones_fault(message))


def _no_zones(_message: Any) -> str | None:
    """What is wrong with any zone set in a version without zones."""
    return "there are no zones in 2.1"
