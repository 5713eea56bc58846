"""What a fleet control knows of one foreign vehicle, from the messages that it sends."""

from collections.abc import Callable, Mapping
from typing import Any

import attrs

from mrpbench_core.files.printing import printable
from mrpbench_live.vda5050.names import Names

IN_CHARGE = frozenset({"AUTOMATIC", "SEMIAUTOMATIC"})
"""Operating modes in which a vehicle follows orders."""
ENDED = frozenset({"FINISHED", "FAILED"})
Say = Callable[[str, str], None]
"""Called with the kind of an event and one line about it."""


@attrs.define(kw_only=True)
class Place:
    """Where a vehicle says that it is."""

    x: float
    """metres."""
    y: float
    """metres."""
    yaw: float
    """radians."""
    speed: float
    """m/s forward; 0 if it does not say."""
    level: int


class ForeignVehicle:
    """One vehicle.

    Args:
        key: manufacturer and serial number, as in topics.
        names: of the version that it speaks.
        levels: index of each level of the world by its name.
        say: what is worth a line.
    """

    def __init__(self, key: str, names: Names, levels: Mapping[str, int], say: Say) -> None:
        self.key, self.say, self._names, self._levels = key, say, names, levels
        self.connection = "nothing"
        """The newest state of its connection."""
        self.state: Mapping[str, Any] | None = None
        self.factsheet: Mapping[str, Any] | None = None
        self.place: Place | None = None
        self.unknown_map: str | None = None
        """A map on which it is, and that the world does not have."""
        self._errors: set[tuple[str, str]] = set()
        """Type and description of those that were said; each is once."""
        self._numbers: dict[str, int] = {}

    def take(self, kind: str, message: Mapping[str, Any]) -> None:
        """Take in a valid message of a topic."""
        if kind == "connection":
            self._connect(str(message["connectionState"]))
        elif kind == "factsheet":
            self.factsheet = message
        elif self._is_new(kind, message["headerId"]):
            if kind == "state":
                self.state = message
                self._hear_errors(message["errors"])
            self._locate(message.get(self._names.position), message.get("velocity", {}))

    def _connect(self, connection: str) -> None:
        if connection == self.connection:
            return
        first, self.connection = self.connection == "nothing", connection
        self._numbers.clear()
        if not (first and self.online):
            self.say("connection", connection)

    def _is_new(self, kind: str, number: int) -> bool:
        """Tell whether a message is newer than those before: messages can come twice, or in another order."""
        known = self._numbers.get(kind)
        if known is not None and not 0 < (number - known) % 2**32 < 2**31:
            return False
        self._numbers[kind] = number
        return True

    def _hear_errors(self, errors: list[Mapping[str, Any]]) -> None:
        found = {(str(error["errorType"]), str(error.get("errorDescription", ""))) for error in errors}
        for kind, description in sorted(found - self._errors):
            self.say("vehicle_error", f"{kind}: {printable(description)}" if description else kind)
        self._errors |= found

    def _locate(self, position: Mapping[str, Any] | None, velocity: Mapping[str, Any]) -> None:
        if position is None or not position.get(self._names.localized, True):
            return
        level = self._levels.get(position["mapId"])
        self.unknown_map = None if level is not None else str(position["mapId"])
        if level is not None:
            x, y, yaw = (float(position[key]) for key in ("x", "y", "theta"))
            speed = float(velocity.get("vx", 0.0))
            self.place = Place(x=x, y=y, yaw=yaw, speed=speed, level=level)

    @property
    def online(self) -> bool:
        """True if it is connected with the broker."""
        return self.connection == "ONLINE"

    @property
    def missing(self) -> str | None:
        """Return the first message that is missing before orders can be sent; None: nothing is."""
        if not self.online:
            return f"no connection message ONLINE, but {self.connection}"
        if self.factsheet is None:
            return "no factsheet"
        if self.state is None:
            return "no state"
        if self.unknown_map is not None:
            return f"no position on a map of the world: it is on {self.unknown_map!r}"
        return "no position in its states" if self.place is None else None

    @property
    def order(self) -> tuple[str, int]:
        """The order that it has: orderId and orderUpdateId."""
        return ("", 0) if self.state is None else (str(self.state["orderId"]), int(self.state["orderUpdateId"]))

    @property
    def idle(self) -> bool:
        """True if it can take a new order (6.6.8)."""
        state = self.state
        if state is None or state["nodeStates"] or state["edgeStates"]:
            return False
        return all(action["actionStatus"] in ENDED for action in state["actionStates"])

    @property
    def driving(self) -> bool:
        """True if it drives."""
        return self.state is not None and bool(self.state["driving"])

    @property
    def unusable(self) -> str | None:
        """Return why it follows no orders although it is connected; None: it does."""
        if self.state is None:
            return None
        fatal = [error for error in self.state["errors"] if error["errorLevel"] == "FATAL"]
        if fatal:
            return str(fatal[0]["errorType"])
        mode = str(self.state["operatingMode"])
        return None if mode in IN_CHARGE else f"it is in the mode {mode}"

    @property
    def twist(self) -> tuple[float, float]:
        """m/s forward and rad/s, as its newest state says; nothing unless it drives."""
        velocity = self.state.get("velocity", {}) if self.state is not None and self.driving else {}
        return float(velocity.get("vx", 0.0)), float(velocity.get("omega", 0.0))

    def supports(self, parameter: str) -> bool:
        """Tell whether its factsheet lists an optional parameter of orders; one that is not listed it cannot use."""
        listed = (self.factsheet or {}).get("protocolFeatures", {}).get("optionalParameters", ())
        return any(it["parameter"] == parameter for it in listed)

    def refusal(self, order: str, update: int) -> str | None:
        """Return the error by which it refuses a message, or None."""
        for error in () if self.state is None else self.state["errors"]:
            about = {it["referenceKey"]: it["referenceValue"] for it in error.get("errorReferences", ())}
            if about.get("orderId") == order and about.get("orderUpdateId", str(update)) == str(update):
                return f"{error['errorType']}: {printable(str(error.get('errorDescription', '')))}".removesuffix(": ")
        return None
