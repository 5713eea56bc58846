"""The zone sets of a vehicle (3.0, 6.4): BLOCKED and SPEED_LIMIT zones; sets with zones of other types are refused."""

from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api import Float
from mrpbench_live.fleet.regions import clearance, placed, touches
from mrpbench_live.fleet.site import Site
from mrpbench_live.vda5050.condition import Here
from mrpbench_live.vda5050.orders import RefusedError

SUPPORTED = "BLOCKED", "SPEED_LIMIT"
"""The types of zones that vehicles understand."""
Polygon = tuple[tuple[float, float], ...]


@attrs.frozen(kw_only=True)
class Zone:
    """A zone."""

    id: str
    type: str
    polygon: Polygon
    """Its corners, in metres."""
    speed: float
    """m/s allowed; inf if it is no SPEED_LIMIT zone."""

    @property
    def corners(self) -> Float:
        """Its corners f8[k,2] in metres."""
        return np.array(self.polygon)


@attrs.define(kw_only=True)
class ZoneSet:
    """Zones of one map."""

    id: str
    level: int
    """Of the map."""
    zones: tuple[Zone, ...]
    enabled: bool = False


class ZoneSets:
    """All zone sets that a vehicle was sent; at most one of each map is enabled.

    Args:
        site: of the fleet.
        robot: that the vehicle is.
    """

    def __init__(self, site: Site, robot: int) -> None:
        self._site, self._robot = site, site.fleet.robots[robot]
        self._sets: dict[str, ZoneSet] = {}
        self.closed: frozenset[int] = frozenset()
        """Edges of the roadmap by which the vehicle would enter a BLOCKED zone."""
        self._blocked: list[tuple[int, Zone]] = []
        self._limits: list[tuple[int, Zone]] = []

    def __bool__(self) -> bool:
        """True if a zone is enabled."""
        return bool(self._blocked or self._limits)

    @property
    def limits_speed(self) -> bool:
        """True if a SPEED_LIMIT zone is enabled."""
        return bool(self._limits)

    def add(self, message: Mapping[str, Any]) -> None:
        """Keep a zone set, which is not enabled yet (6.4.2).

        Args:
            message: valid by its schema.

        Raises:
            RefusedError: the vehicle has a set of this id, does not know its map, or cannot keep to a zone of it.
        """
        given = message["zoneSet"]
        refers = {"topic": "zoneSet", "zoneSetId": given["zoneSetId"]}
        self.check_new(given["zoneSetId"])
        level = self._site.level_of.get(given["mapId"])
        if level is None:
            what = f"no map is called {given['mapId']!r}, only {', '.join(sorted(self._site.levels))}"
            raise RefusedError("UNKNOWN_MAP_ID", what, refers | {"mapId": given["mapId"]})
        zones = tuple(_zone_of(zone, refers) for zone in given["zones"])
        if len({zone.id for zone in zones}) < len(zones):
            raise RefusedError("VALIDATION_FAILURE", "two zones have the same zoneId", refers)
        self._sets[given["zoneSetId"]] = ZoneSet(id=given["zoneSetId"], level=level, zones=zones)

    def check_new(self, name: str) -> None:
        """Check that there is no zone set of a name yet.

        Raises:
            RefusedError: there is one.
        """
        if name in self._sets:
            refers = {"topic": "zoneSet", "zoneSetId": name}
            raise RefusedError("DUPLICATE_ZONE_SET", f"there is a zone set {name!r} already", refers)

    def enable(self, name: Any) -> str | None:
        """Enable a zone set, and no other one of its map; return why that is impossible, or None."""
        chosen = self._sets.get(name) if isinstance(name, str) else None
        if chosen is None:
            return f"there is no zone set {name!r}"
        for other in self._sets.values():
            if other.level == chosen.level:
                other.enabled = other is chosen
        enabled = [(it.level, zone) for it in self._sets.values() if it.enabled for zone in it.zones]
        self._blocked = [(level, zone) for level, zone in enabled if zone.type == "BLOCKED"]
        self._limits = [(level, zone) for level, zone in enabled if zone.type == "SPEED_LIMIT"]
        radius = self._robot.radius
        self.closed = frozenset().union(*(self._site.entering(at, it.polygon, radius) for at, it in self._blocked))
        return None

    def delete(self, name: Any) -> str | None:
        """Forget a zone set; return why that is impossible, or None."""
        chosen = self._sets.get(name) if isinstance(name, str) else None
        if chosen is None:
            return f"there is no zone set {name!r}"
        if chosen.enabled:
            return "the zone set is enabled"
        del self._sets[chosen.id]
        return None

    def states(self) -> list[dict[str, Any]]:
        """Return what states tell of the zone sets."""
        return [
            {
                "zoneSetId": it.id,
                "mapId": self._site.levels[it.level],
                "zoneSetStatus": "ENABLED" if it.enabled else "DISABLED",
            }
            for it in self._sets.values()
        ]

    def violated(self, here: Here) -> str | None:
        """Return the BLOCKED zone that the contour of the vehicle touches, or None."""
        near = [zone for level, zone in self._blocked if level == here.level]
        if not near:
            return None
        body = placed(self._robot.footprint, here.pose)
        return next((zone.id for zone in near if touches(body, zone.corners)), None)

    def speed(self, here: Here, ahead: Float) -> float:
        """Return the m/s that SPEED_LIMIT zones allow, inf if there is none where the vehicle is or so near.

        A limit holds from where the vehicle has to brake for it. Its body counts as a disc.

        Args:
            here: where it is.
            ahead: f8[k,2] metres, the places that it comes to next.
        """
        near = [zone for level, zone in self._limits if level == here.level]
        if not near:
            return float("inf")
        robot = self._robot
        braking = robot.max_speed**2 / (2 * robot.acceleration) + robot.max_speed  # and what it drives in a second
        line = np.concatenate([[here.pose[:2]], ahead, ahead[-1:] if len(ahead) else [here.pose[:2]]])
        tail, head = line[:-1], line[1:]
        length = np.hypot(*(head - tail).T)
        soon = np.concatenate([[0.0], np.cumsum(length)[:-1]]) <= braking
        tail, head = tail[soon], head[soon]
        slow = [it.speed for it in near if (clearance(tail, head, it.corners) < robot.radius).any()]
        return min(slow, default=float("inf"))


def _zone_of(zone: Mapping[str, Any], refers: Mapping[str, str]) -> Zone:
    """Read a zone of a valid message, and check what its schema says of single types."""
    found = {**refers, "zoneId": zone["zoneId"]}

    def refuse(what: str) -> RefusedError:
        return RefusedError("VALIDATION_FAILURE", f"zone {zone['zoneId']!r} {what}", found)

    polygon = tuple((float(it["x"]), float(it["y"])) for it in zone["vertices"])
    if len(polygon) < 3 or not np.isfinite(polygon).all():
        raise refuse("needs at least three vertices at finite places")
    if zone["zoneType"] not in SUPPORTED:
        what = f"zone {zone['zoneId']!r}: zones of type {zone['zoneType']} are not supported"
        raise RefusedError("UNSUPPORTED_PARAMETER", what, found | {"parameter": "zoneType"}, "CRITICAL")
    speed: Any = float("inf")
    if zone["zoneType"] == "SPEED_LIMIT":
        speed = zone.get("maximumSpeed")
        if isinstance(speed, bool) or not isinstance(speed, int | float) or not 0 < speed < float("inf"):
            raise refuse(f"has the maximumSpeed {speed}, not a number above 0")
    return Zone(id=zone["zoneId"], type=zone["zoneType"], polygon=polygon, speed=float(speed))
