"""Instant actions: what a vehicle does at once, whatever its order says (6.2.1)."""

import math
from collections.abc import Callable, Mapping
from typing import Any

from mrpbench_live.vda5050.actions import Action
from mrpbench_live.vda5050.download import Download
from mrpbench_live.vda5050.errors import UNTIL_NEXT_INSTANT_ACTION, UNTIL_NEXT_ORDER
from mrpbench_live.vda5050.names import Names
from mrpbench_live.vda5050.orders import RefusedError
from mrpbench_live.vda5050.scopes import scopes_of
from mrpbench_live.vda5050.track import Track, distance
from mrpbench_live.vda5050.vehicle import Vehicle

EMPTY_HEADER = {
    "headerId": 0,
    "timestamp": "1970-01-01T00:00:00.000Z",
    "version": "",
    "manufacturer": "",
    "serialNumber": "",
}
"""What the file of a zone set need not have."""
AGREES = 1.0
"""Metres from its place at which a vehicle takes a position for its own."""


class InstantActions:
    """Performs the instant actions of one vehicle.

    Args:
        vehicle: that performs them.
        track: its path.
        names: of the version that it speaks.
        note: called with the kind of an event and one line about it.
        zone_set_fault: says what is wrong with a zone set by its schema, or None.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        track: Track,
        names: Names,
        note: Callable[[str, str], None],
        zone_set_fault: Callable[[Any], str | None],
    ) -> None:
        self._vehicle, self._track, self._names, self._note = vehicle, track, names, note
        self._zone_set_fault = zone_set_fault
        self._downloads: list[tuple[Action, Download]] = []
        self._perform: Mapping[str, Callable[[Action], None]] = {
            "cancelOrder": self._cancel_order,
            "startPause": self._start_pause,
            "stopPause": self._stop_pause,
            "stateRequest": self._end,
            "factsheetRequest": self._request_factsheet,
            "clearInstantActions": self._clear,
            "trigger": self._trigger,
            "initializePosition": self._initialize_position,
            "startCharging": self._start_charging,
            "stopCharging": self._stop_charging,
            "downloadZoneSet": self._download_zone_set,
            "enableZoneSet": self._enable_zone_set,
            "deleteZoneSet": self._delete_zone_set,
        }

    @property
    def restless(self) -> bool:
        """True if an action may end although nothing happens to the vehicle."""
        return bool(self._downloads)

    def advance(self) -> None:
        """End downloads that are over."""
        for action, download in [it for it in self._downloads if it[1].over]:
            self._downloads.remove((action, download))
            self._end_download(action, download)

    def take(self, message: Any, fault: str | None) -> None:
        """Perform instant actions, or refuse them; `fault`: what is wrong with the message by its schema."""
        vehicle = self._vehicle
        if fault is not None:
            refusal = RefusedError("INVALID_INSTANT_ACTION", fault, {"topic": "instantActions"})
            vehicle.errors.refuse(refusal, UNTIL_NEXT_INSTANT_ACTION)
            return
        for action in map(Action.of, message["actions"]):
            if action.id in vehicle.instant or action.id in vehicle.actions:  # the fleet control repeats itself
                continue
            vehicle.instant[action.id], vehicle.changed = action, True
            kind = "initializePosition" if action.type == self._names.initialize_position else action.type
            if "INSTANT" not in scopes_of(self._names).get(kind, ()):
                action.status = "FAILED"
                refers = {"topic": "instantActions", "actionId": action.id, "actionType": action.type}
                what = f"the instant action {action.type!r} does not exist"
                vehicle.errors.refuse(RefusedError("INVALID_INSTANT_ACTION", what, refers), UNTIL_NEXT_INSTANT_ACTION)
                continue
            vehicle.errors.end(UNTIL_NEXT_INSTANT_ACTION)
            action.status, action.begun = "RUNNING", True
            self._note("instant_action", f"{action.type} {action.id}")
            self._perform[kind](action)

    def _cancel_order(self, action: Action) -> None:
        vehicle, wanted = self._vehicle, action.parameters.get("orderId")
        active = str(vehicle.order["orderId"]) if vehicle.order is not None and vehicle.cancellable else None
        if active is not None and wanted in (None, active):
            vehicle.cancel(action)
            return
        action.status = "FAILED"
        what = "there is no active order" if active is None else f"the order {wanted!r} is not active"
        vehicle.errors.refuse(RefusedError("NO_ORDER_TO_CANCEL", what, {"actionId": action.id}), UNTIL_NEXT_ORDER)

    def _start_pause(self, action: Action) -> None:
        self._vehicle.pause, self._vehicle.paused = action, True

    def _stop_pause(self, action: Action) -> None:
        if self._vehicle.pause is not None and not self._vehicle.pause.ended:
            self._vehicle.pause.status = "FAILED"
        self._vehicle.pause, self._vehicle.paused = None, False
        self._end(action)

    def _end(self, action: Action) -> None:
        action.status = "FINISHED"

    def _request_factsheet(self, action: Action) -> None:
        self._vehicle.wants_factsheet = True
        self._end(action)

    def _clear(self, action: Action) -> None:
        known = self._vehicle.instant.items()
        self._vehicle.instant = {key: other for key, other in known if not other.ended}
        self._end(action)

    def _trigger(self, action: Action) -> None:
        waiting = [other for other in self._vehicle.queue.running() if other.type == "waitForTrigger"]
        action.status = "FINISHED" if waiting else "FAILED"
        for other in waiting:
            other.status = "FINISHED"

    def _initialize_position(self, action: Action) -> None:
        """Agree, or refuse: the vehicle knows where it is."""
        vehicle, given = self._vehicle, action.parameters
        place, last = (_number(given.get("x")), _number(given.get("y"))), given.get("lastNodeId")
        on_map = given.get("mapId") in (None, self._track.maps[vehicle.here.level])
        if on_map and distance(vehicle.here.pose, place) <= AGREES:
            if vehicle.idle and isinstance(last, str):
                vehicle.last_node = last
            self._end(action)
        else:
            action.status, action.result = "FAILED", "the vehicle is elsewhere"

    def _start_charging(self, action: Action) -> None:
        if self._vehicle.here.driving:
            action.status, action.result = "FAILED", "the vehicle drives"
        else:
            self._vehicle.charging = True
            self._end(action)

    def _stop_charging(self, action: Action) -> None:
        self._vehicle.charging = False
        self._end(action)

    def _download_zone_set(self, action: Action) -> None:
        given = [action.parameters.get(key, "") for key in ("zoneSetId", "zoneSetDownloadLink", "zoneSetHash")]
        name, link, digest = given
        if not all(isinstance(it, str) for it in given) or not name or not link:
            self._end_with(action, "it needs a zoneSetId and a zoneSetDownloadLink")
        elif (fault := self._vehicle.known_zone_set(name)) is not None:
            self._end_with(action, fault)
        else:
            self._downloads.append((action, Download(link, digest)))

    def _end_download(self, action: Action, download: Download) -> None:
        vehicle, name = self._vehicle, action.parameters["zoneSetId"]
        vehicle.changed = True
        if download.fault is not None:
            self._end_with(action, download.fault)
            return
        content = download.content
        message = {**EMPTY_HEADER, **content} if isinstance(content, dict) else content
        fault = self._zone_set_fault(message)
        if fault is None and message["zoneSet"]["zoneSetId"] != name:
            fault = f"the zone set is called {message['zoneSet']['zoneSetId']!r} and not {name!r}"
        self._end_with(action, vehicle.take_zones(message, fault))

    def _enable_zone_set(self, action: Action) -> None:
        self._end_with(action, self._vehicle.zones.enable(action.parameters.get("zoneSetId")))

    def _delete_zone_set(self, action: Action) -> None:
        self._end_with(action, self._vehicle.zones.delete(action.parameters.get("zoneSetId")))

    def _end_with(self, action: Action, fault: str | None) -> None:
        """End an action about zone sets; `fault`: why it fails, or None."""
        if fault is None:
            self._vehicle.zones_changed()
            self._end(action)
        else:
            action.status, action.result = "FAILED", fault


def _number(value: Any) -> float:
    """Return a parameter as a number, NaN if it is none."""
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else math.nan
