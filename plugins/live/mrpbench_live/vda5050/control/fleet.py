"""The connection of a fleet control with its vehicles."""

import json
import time
import uuid
from collections.abc import Mapping, Sequence
from typing import Any

from mrpbench_core.api import Event, InputError
from mrpbench_live.vda5050.control.sender import REACH
from mrpbench_live.vda5050.control.vehicle import ForeignVehicle
from mrpbench_live.vda5050.messages import Headers, read
from mrpbench_live.vda5050.names import VERSIONS
from mrpbench_live.vda5050.schemas import validator
from mrpbench_live.vda5050.wire import Broker, Client, Wire

CONNECTING_S = 10.0
TOPICS = "connection", "factsheet", "state", "visualization"


class ForeignFleet:
    """All vehicles on a broker; those that stand at the starts of robots are theirs.

    Args:
        url: of the broker.
        version: `2.1` or `3.0`.
        topics: what topics begin with, empty: as usual.
        levels: names of the levels of the world.

    Raises:
        InputError: there is no broker, or a library is missing.
    """

    def __init__(self, url: str, version: str, topics: str, levels: Sequence[str]) -> None:
        self.names = VERSIONS[version]
        self.levels = tuple(levels)
        self.run = uuid.uuid4().hex[:8]
        """Part of the ids of orders, which are not used again."""
        self.robots: list[ForeignVehicle] = []
        """The vehicle of each robot, when they are met."""
        self._prefix = topics or self.names.topics
        self._level_of = {name: index for index, name in enumerate(levels)}
        self._found: dict[str, ForeignVehicle] = {}
        self._events: list[tuple[ForeignVehicle, str, str]] = []
        self._invalid: set[tuple[str, str]] = set()
        self._headers: dict[str, Headers] = {}
        self._faults = {topic: validator(version, topic) for topic in TOPICS}
        self._wire = Wire(Broker.of(url))
        wanted = tuple(f"{self._prefix}/+/+/{topic}" for topic in TOPICS)
        self._client = Client(self._wire, f"mrpbench-control-{self.run}", None, wanted, lambda: None, self._take)
        self._wire.add(self._client)
        self._wire.meet(CONNECTING_S)

    def meet(self, starts: Sequence[tuple[str, float, float, int]], seconds: float) -> None:
        """Wait until a vehicle stands at the start of each robot, and can take an order.

        Args:
            starts: of the robots: name, x, y (metres) and level.
            seconds: of wall time, for all of them.

        Raises:
            InputError: some vehicle is missing, with the first message that it did not send.
        """
        until, cancelled, asked = time.monotonic() + seconds, set[str](), set[str]()
        while True:
            self.serve(time.monotonic() + 0.05)
            found = [self._nearest(x, y, level) for _, x, y, level in starts]
            self.robots = [vehicle for vehicle in found if vehicle is not None and vehicle.missing is None]
            for vehicle in self.robots:
                if not vehicle.idle and vehicle.key not in cancelled:
                    self.cancel(vehicle)
                    cancelled.add(vehicle.key)
            for vehicle in self._found.values():
                if vehicle.online and vehicle.factsheet is None and vehicle.key not in asked:
                    self._act(vehicle, "factsheetRequest")  # some send none unasked
                    asked.add(vehicle.key)
            if len(self.robots) == len(starts) and all(vehicle.idle for vehicle in self.robots):
                self._events.clear()
                return
            if time.monotonic() > until:
                raise self._absent(starts, found, seconds)

    def _nearest(self, x: float, y: float, level: int) -> ForeignVehicle | None:
        """The nearest vehicle within reach of a place."""

        def away(vehicle: ForeignVehicle) -> float:
            place = vehicle.place
            if place is None or place.level != level:
                return float("inf")
            return float(((place.x - x) ** 2 + (place.y - y) ** 2) ** 0.5)

        found = min(self._found.values(), key=away, default=None)
        return None if found is None or away(found) > REACH else found

    def _absent(
        self, starts: Sequence[tuple[str, float, float, int]], found: Sequence[ForeignVehicle | None], seconds: float
    ) -> InputError:
        """Say what is missing."""
        where = f"after {seconds:g} s"
        lost = [start for start, vehicle in zip(starts, found, strict=True) if vehicle is None]
        silent = [vehicle for vehicle in self._found.values() if vehicle.missing is not None]
        if silent:
            others = f"; {len(silent) - 1} more vehicles lack messages" if len(silent) > 1 else ""
            return InputError(f"vda5050: {where} {silent[0].key} has sent {silent[0].missing}{others}")
        if not self._found:
            hint = f"topics are {self._prefix}/MANUFACTURER/SERIAL/state and so on; `topics` and `version` change them"
            return InputError(f"vda5050: {where} no vehicle has sent anything", hint=hint)
        if lost:
            name, x, y, level = lost[0]
            hint = "the starts of the scenario are where vehicles stand: `scenario: {plugin: file, …}`"
            others = f", nor at {len(lost) - 1} more starts" if len(lost) > 1 else ""
            place = f"({x:.2f}, {y:.2f}) on {self.levels[level]}"
            return InputError(f"vda5050: {where} no vehicle stands at the start of {name}, {place}{others}", hint=hint)
        busy = next(vehicle for vehicle in self.robots if not vehicle.idle)
        return InputError(f"vda5050: {where} {busy.key} still has the order {busy.order[0]!r}, which was cancelled")

    def serve(self, until: float) -> None:
        """Send and receive until a time of `time.monotonic`."""
        self._wire.serve(until)

    def send(self, vehicle: ForeignVehicle, topic: str, body: Mapping[str, Any]) -> bool:
        """Send a message to a vehicle; tell whether there is a connection."""
        manufacturer, _, serial = vehicle.key.partition("/")
        headers = self._headers.setdefault(vehicle.key, Headers(self.names.version, manufacturer, serial))
        if not self._client.connected:
            return False
        message = json.dumps({**headers.next(topic), **body}).encode()
        return self._client.publish(f"{self._prefix}/{vehicle.key}/{topic}", message)

    def cancel(self, vehicle: ForeignVehicle) -> None:
        """Cancel the order of a vehicle."""
        self._act(vehicle, "cancelOrder")

    def _act(self, vehicle: ForeignVehicle, kind: str) -> None:
        """Send an instant action."""
        blocking = "NONE" if self.names.has_instant_states or kind != "cancelOrder" else "HARD"
        action = {"actionType": kind, "actionId": uuid.uuid4().hex, "blockingType": blocking}
        self.send(vehicle, "instantActions", {"actions": [action]})

    def events(self, now: float) -> tuple[Event, ...]:
        """Return what has happened since the last call, for the recording."""
        number = {vehicle.key: robot for robot, vehicle in enumerate(self.robots)}
        found = [
            Event(stamp=now, kind=kind, robot=number[vehicle.key], detail=f"{vehicle.key}: {detail}")
            for vehicle, kind, detail in self._events
            if vehicle.key in number
        ]
        self._events.clear()
        return tuple(found)

    def close(self) -> None:
        """Cancel the orders that are not done, and leave."""
        for vehicle in self.robots:
            if not vehicle.idle:
                self.cancel(vehicle)
        self._wire.close()

    def _take(self, topic: str, payload: bytes) -> None:
        """Take in a message of a vehicle, whatever it is."""
        *_, manufacturer, serial, kind = topic.split("/")
        key = f"{manufacturer}/{serial}"
        message, fault = read(payload)
        fault = fault or self._faults[kind](message)
        if key not in self._found:
            self._found[key] = self._new(key)
        vehicle = self._found[key]
        if fault is None:
            vehicle.take(kind, message)
        elif (key, kind) not in self._invalid:
            self._invalid.add((key, kind))
            vehicle.say("invalid_message", fault)

    def _new(self, key: str) -> ForeignVehicle:
        def say(kind: str, detail: str) -> None:
            self._events.append((vehicle, kind, detail))

        vehicle = ForeignVehicle(key, self.names, self._level_of, say)
        return vehicle
