"""The messages of a vehicle: state, visualization, connection and factsheet."""

import json
import math
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from mrpbench_core.api import RobotModel
from mrpbench_live.vda5050.actions import Action
from mrpbench_live.vda5050.names import Names
from mrpbench_live.vda5050.scopes import scopes_of
from mrpbench_live.vda5050.vehicle import Vehicle
from mrpbench_live.vda5050.zones import SUPPORTED

LARGEST_THETA = 3.1415
"""Radians: what is nearer to half a turn would be rounded to more than the schemas allow."""
LARGEST = 4_000_000
"""Bytes of a message at most."""
_OPTIONAL = (
    "nodes.nodePosition",
    "nodes.nodePosition.allowedDeviationXY",
    "nodes.nodePosition.allowedDeviationTheta",
    "edges.length",
    "edges.rotationAllowed",
    "edges.corridor",
)
"""Optional parameters of orders that vehicles use. What a factsheet does not list counts as not supported (7.10)."""


class Headers:
    """Counts the messages of one sender on each of its topics (6.4).

    Args:
        version: of the protocol.
        manufacturer: of the vehicle.
        serial: number of the vehicle.
    """

    def __init__(self, version: str, manufacturer: str, serial: str) -> None:
        self._fixed = {"version": version, "manufacturer": manufacturer, "serialNumber": serial}
        self._counts: dict[str, int] = {}

    def next(self, topic: str) -> dict[str, Any]:
        """Return the header of the next message on a topic."""
        number = self._counts.get(topic, -1) + 1
        self._counts[topic] = number & 0xFFFFFFFF
        return {"headerId": self._counts[topic], "timestamp": timestamp(), **self._fixed}

    def last(self, topic: str) -> int:
        """Return the number of the last message on a topic, 0 if there was none."""
        return max(0, self._counts.get(topic, 0))


def read(payload: bytes) -> tuple[Any, str | None]:
    """Read a message of a fleet control, whatever it is; the second value says why that is impossible, or None."""
    if len(payload) > LARGEST:
        return None, f"{len(payload)} bytes are more than {LARGEST}"
    try:
        return json.loads(payload, parse_int=_integer), None
    except (ValueError, RecursionError) as error:  # text in another encoding is a ValueError, too
        return None, f"the message is not JSON: {error}"


def _integer(text: str) -> int:
    """Return a number of 64 bits, with which all else can compute."""
    number = int(text)
    if abs(number) >= 2**63:
        raise ValueError(f"{text[:20]}… is too large")
    return number


def timestamp() -> str:
    """Return the time as all messages have it: UTC with milliseconds."""
    return datetime.now(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def position_of(vehicle: Vehicle, maps: Sequence[str], names: Names) -> dict[str, Any]:
    """Return where a vehicle is."""
    x, y, yaw = vehicle.here.pose
    theta = min(max(round(math.remainder(yaw, 2 * math.pi), 4), -LARGEST_THETA), LARGEST_THETA)
    place = {"x": round(x, 4), "y": round(y, 4), "theta": theta}
    return {**place, "mapId": maps[vehicle.here.level], names.localized: True}


def velocity_of(vehicle: Vehicle) -> dict[str, float]:
    """Return how fast a vehicle is, in its own frame."""
    return dict(zip(("vx", "vy", "omega"), (round(value, 4) for value in vehicle.here.velocity), strict=True))


def state_of(vehicle: Vehicle, maps: Sequence[str], names: Names) -> dict[str, Any]:
    """Return the state of a vehicle without its header."""
    order = vehicle.order or {"orderId": "", "orderUpdateId": 0}
    actions, instant = list(vehicle.actions.values()), list(vehicle.instant.values())
    state = {
        "maps": [{"mapId": name, "mapVersion": "1", "mapStatus": "ENABLED"} for name in maps],
        "orderId": order["orderId"],
        "orderUpdateId": order["orderUpdateId"],
        "lastNodeId": vehicle.last_node,
        "lastNodeSequenceId": vehicle.last_sequence,
        "nodeStates": [
            {"nodeId": node.id, "sequenceId": node.sequence, "released": node.released} for node in vehicle.nodes
        ],
        "edgeStates": [
            {key: edge.message[key] for key in ("edgeId", "sequenceId", "released")} for edge in vehicle.edges
        ],
        names.position: position_of(vehicle, maps, names),
        "velocity": velocity_of(vehicle),
        "loads": [] if vehicle.load is None else [{"loadId": vehicle.load}],
        "driving": vehicle.here.driving,
        "paused": vehicle.paused,
        "newBaseRequest": vehicle.new_base,
        "actionStates": [
            _action_state(it, names) for it in (actions if names.has_instant_states else actions + instant)
        ],
        names.power: {names.charge: round(100 * vehicle.charge, 3), "charging": vehicle.charging},
        "operatingMode": "AUTOMATIC" if vehicle.available else "MANUAL",
        "errors": [
            {
                "errorType": error.type,
                "errorLevel": error.level,
                "errorDescription": error.description,
                "errorReferences": [
                    {"referenceKey": key, "referenceValue": str(value)} for key, value in error.references.items()
                ],
            }
            for error in vehicle.errors
        ],
        "safetyState": {names.emergency_stop: "NONE", "fieldViolation": False},
    }
    if names.zones:
        state["zoneSets"] = vehicle.zones.states()
    if names.has_instant_states:
        state["instantActionStates"] = [_action_state(it, names) for it in instant]
    return state


def _action_state(action: Action, names: Names) -> dict[str, Any]:
    found = {"actionId": action.id, "actionType": action.type, "actionStatus": action.status}
    return {**found, names.result: action.result} if action.result else found


def factsheet_of(
    robot: RobotModel, names: Names, intervals: tuple[float, float, float], headings: bool
) -> dict[str, Any]:
    """Return the factsheet of a vehicle without its header.

    Args:
        robot: its model.
        names: of the version that it speaks.
        intervals: seconds between states at least, usually, and between visualizations.
        headings: it can take the orientation that a node asks for.
    """
    optional = [f"order.{name}" for name in (*_OPTIONAL, f"edges.{names.maximum_speed}")]
    optional += ["order.nodes.nodePosition.theta"] if headings else []
    supported = [{"parameter": name, "support": "SUPPORTED"} for name in optional]
    minimum, usual, visualization = intervals
    width, length = (float(extent) for extent in (robot.footprint.max(axis=0) - robot.footprint.min(axis=0))[::-1])
    kind = {"seriesName": robot.name, "localizationTypes": ["NATURAL"], "navigationTypes": ["VIRTUAL_LINE_GUIDED"]}
    scopes: Mapping[str, Sequence[str]] = scopes_of(names)
    corners = [{"x": float(x), "y": float(y)} for x, y in robot.footprint]
    if names.single:
        return {
            "typeSpecification": {
                **kind,
                "mobileRobotKinematics": "DIFFERENTIAL",
                "mobileRobotClass": "CARRIER",
                "maximumLoadMass": 0.0,
                "supportedZones": list(SUPPORTED),
            },
            "physicalParameters": {
                "minimumSpeed": 0.0,
                "maximumSpeed": robot.max_speed,
                "maximumAngularSpeed": robot.max_turn_rate,
                "maximumAcceleration": robot.acceleration,
                "maximumDeceleration": robot.acceleration,
                "minimumHeight": robot.height,
                "maximumHeight": robot.height,
                "width": width,
                "length": length,
            },
            "protocolLimits": {
                "maximumStringLengths": {},
                "maximumArrayLengths": {},
                "timing": {
                    "minimumOrderInterval": 0.0,
                    "minimumStateInterval": minimum,
                    "defaultStateInterval": usual,
                    "visualizationInterval": visualization,
                },
            },
            "protocolFeatures": {
                "optionalParameters": supported,
                "mobileRobotActions": [
                    {"actionType": name, "actionScopes": list(where), "pauseAllowed": False, "cancelAllowed": True}
                    for name, where in scopes.items()
                ],
            },
            "mobileRobotGeometry": {"envelopes2d": [{"envelope2dId": "footprint", "vertices": corners}]},
            "loadSpecification": {},
        }
    return {
        "typeSpecification": {**kind, "agvKinematic": "DIFF", "agvClass": "CARRIER", "maxLoadMass": 0.0},
        "physicalParameters": {
            "speedMin": 0.0,
            "speedMax": robot.max_speed,
            "accelerationMax": robot.acceleration,
            "decelerationMax": robot.acceleration,
            "heightMax": robot.height,
            "width": width,
            "length": length,
        },
        "protocolLimits": {
            "maxStringLens": {},
            "maxArrayLens": {},
            "timing": {
                "minOrderInterval": 0.0,
                "minStateInterval": minimum,
                "defaultStateInterval": usual,
                "visualizationInterval": visualization,
            },
        },
        "protocolFeatures": {
            "optionalParameters": supported,
            "agvActions": [
                {
                    "actionType": names.initialize_position if name == "initializePosition" else name,
                    "actionScopes": list(where),
                }
                for name, where in scopes.items()
            ],
        },
        "agvGeometry": {"envelopes2d": [{"set": "footprint", "polygonPoints": corners}]},
        "loadSpecification": {},
    }
