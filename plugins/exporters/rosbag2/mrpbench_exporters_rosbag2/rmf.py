"""Messages of Open-RMF's `rmf_fleet_msgs`, `rmf_door_msgs` and `rmf_lift_msgs`, from the documentation of its releases.

ROS itself does not have them. A reader with a definition of its own needs the one that it knows. That of fleets has
grown: galactic has 1.4, humble 3.0 (as all up to jazzy), rolling 4.0.
https://docs.ros.org/en/humble/p/rmf_fleet_msgs
"""

from functools import cache
from typing import Any, Literal

from rosbags.typesys.store import Typestore

from mrpbench_exporters_rosbag2.messages import with_types

Release = Literal["galactic", "humble", "rolling"]

LIMIT = "bool obey_approach_speed_limit\nfloat32 approach_speed_limit\n"
ACTION = "string performing_action\n"
IDLE, MOVING, WAITING, ADAPTER_ERROR = 0, 2, 4, 8
"""Modes of robots."""
CLOSED, OPENING, OPEN = 0, 1, 2
"""Modes of doors, and of the doors of a lift; 1 is any motion."""
LIFT_STOPPED, LIFT_UP, LIFT_DOWN = 0, 1, 2
"""Motions of lifts."""
LIFT_FOR_ROBOTS = 2
"""The mode of a lift that robots use."""
FACILITIES = {
    "rmf_door_msgs/msg/DoorMode": "uint32 value\n",
    "rmf_door_msgs/msg/DoorState": "builtin_interfaces/Time door_time\nstring door_name\nDoorMode current_mode\n",
    "rmf_lift_msgs/msg/LiftState": "builtin_interfaces/Time lift_time\nstring lift_name\nstring[] available_floors\n"
    "string current_floor\nstring destination_floor\nuint8 door_state\nuint8 motion_state\nuint8[] available_modes\n"
    "uint8 current_mode\nstring session_id\n",
}
"""Definitions without their constants, which are no part of a message; the same from Galactic to Rolling."""


@cache
def facility_types() -> Typestore:
    """The types of Humble, and those of the states of doors and lifts."""
    return with_types(FACILITIES)


@cache
def rmf_types(release: Release) -> Typestore:
    """The types of Humble, and those of fleet states as of an RMF release."""
    limit = "" if release == "galactic" else LIMIT
    action = ACTION if release == "rolling" else ""
    definitions = {
        "Location": f"builtin_interfaces/Time t\nfloat32 x\nfloat32 y\nfloat32 yaw\n{limit}"
        "string level_name\nuint64 index\n",
        "RobotMode": f"uint32 mode\nuint64 mode_request_id\n{action}",
        "RobotState": "string name\nstring model\nstring task_id\nuint64 seq\nRobotMode mode\nfloat32 battery_percent\n"
        "Location location\nLocation[] path\n",
        "FleetState": "string name\nRobotState[] robots\n",
    }
    return with_types({f"rmf_fleet_msgs/msg/{name}": text for name, text in definitions.items()})


def rmf_message(types: Typestore, name: str, /, **fields: Any) -> Any:
    """Make a message; fields that the release does not know yet are left out."""
    kind = types.types[f"rmf_fleet_msgs/msg/{name}"]
    return kind(**{field: fields[field] for field, _ in types.fielddefs[f"rmf_fleet_msgs/msg/{name}"][1]})
