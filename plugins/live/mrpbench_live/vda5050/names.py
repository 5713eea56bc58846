"""What differs between versions 2.1 and 3.0 of VDA 5050: names, levels of errors, and topics."""

from collections.abc import Mapping
from typing import Any

import attrs


@attrs.frozen(kw_only=True)
class Names:
    """The names of one version. Everything else in this package is written in the words of 3.0."""

    version: str
    topics: str
    """What topics of this version usually begin with: interface and major version."""
    position: str
    localized: str
    power: str
    charge: str
    emergency_stop: str
    connection_broken: str
    initialize_position: str
    maximum_speed: str
    description: str
    """The field of a description of nodes, edges and actions."""
    result: str
    errors: Mapping[str, tuple[str, str]]
    """Type and level of each error; those that are missing keep the name and the level of 3.0."""
    unsupported: frozenset[str]
    """Optional fields of nodes and edges that the vehicles cannot use."""
    has_instant_states: bool
    """States of instant actions have an array of their own."""
    single: bool
    """The blocking type SINGLE exists."""
    zones: bool
    """Zones exist."""

    def error(self, kind: str, level: str) -> tuple[str, str]:
        """Return type and level of an error of 3.0 in this version."""
        return self.errors.get(kind, (kind, level))

    def deviation(self, position: Mapping[str, Any]) -> float | None:
        """Return the metres within which a node counts as traversed, None if the order does not say."""
        given = position.get("allowedDeviationXY")
        if isinstance(given, Mapping):  # an ellipse, of which this is the circle inside
            return min(float(given["a"]), float(given["b"]))
        return None if given is None else float(given)

    def allowed_deviation(self, metres: float) -> object:
        """Return `allowedDeviationXY` of a node that counts as traversed within some metres."""
        return {"a": metres, "b": metres, "theta": 0.0} if self.single else metres


_ORDER = {
    "VALIDATION_FAILURE": ("validationError", "WARNING"),
    "UNSUPPORTED_PARAMETER": ("orderError", "WARNING"),
    "INVALID_ORDER_ACTION": ("orderError", "WARNING"),
    "INVALID_INSTANT_ACTION": ("actionError", "WARNING"),
    "OUTDATED_ORDER_UPDATE": ("orderUpdateError", "WARNING"),
    "SAME_ORDER_UPDATE_ID": ("orderUpdateError", "WARNING"),
    "ORDER_UPDATE_FOLLOWING_CANCEL": ("orderUpdateError", "WARNING"),
    "OTHER_ORDER_ACTIVE": ("orderError", "WARNING"),
    "START_NODE_OUT_OF_RANGE": ("noRouteError", "WARNING"),
    "NO_ROUTE_TO_TARGET": ("noRouteError", "WARNING"),
    "UNKNOWN_MAP_ID": ("orderError", "WARNING"),
    "MOBILE_ROBOT_NOT_AVAILABLE": ("orderError", "WARNING"),
    "NO_ORDER_TO_CANCEL": ("noOrderToCancel", "WARNING"),
    "NO_STITCHING": ("orderUpdateError", "WARNING"),
    "NODE_UNREACHABLE": ("nodeUnreachable", "FATAL"),
    "OUTSIDE_OF_CORRIDOR": ("outsideOfCorridor", "FATAL"),
}
_FIELDS = frozenset({"trajectory", "orientation", "direction"})
VERSIONS = {
    "2.1": Names(
        version="2.1.0",
        topics="uagv/v2",
        position="agvPosition",
        localized="positionInitialized",
        power="batteryState",
        charge="batteryCharge",
        emergency_stop="eStop",
        connection_broken="CONNECTIONBROKEN",
        initialize_position="initPosition",
        maximum_speed="maxSpeed",
        description="Description",
        result="resultDescription",
        errors=_ORDER,
        unsupported=_FIELDS | {"maxHeight", "minHeight", "maxRotationSpeed", "zoneSetId"},
        has_instant_states=False,
        single=False,
        zones=False,
    ),
    "3.0": Names(
        version="3.0.0",
        topics="vda5050/v3",
        position="mobileRobotPosition",
        localized="localized",
        power="powerSupply",
        charge="stateOfCharge",
        emergency_stop="activeEmergencyStop",
        connection_broken="CONNECTION_BROKEN",
        initialize_position="initializePosition",
        maximum_speed="maximumSpeed",
        description="Descriptor",
        result="actionResult",
        errors={"NO_STITCHING": ("NO_ROUTE_TO_TARGET", "WARNING")},
        unsupported=_FIELDS
        | {"maximumMobileRobotHeight", "minimumLoadHandlingDeviceHeight", "maxRotationSpeed", "maximumRotationSpeed"},
        has_instant_states=True,
        single=True,
        zones=True,
    ),
}
"""The names of each version, by its number in configurations."""
