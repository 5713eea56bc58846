"""States of doors and lifts: `/door_states` and `/lift_states` of Open-RMF, and `/facilities`, the exact numbers."""

from collections.abc import Iterator, Mapping

import numpy as np

from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.facilities import LEVEL_TOLERANCE, Facilities
from mrpbench_core.model.worlds.world import Lift, World
from mrpbench_exporters_rosbag2.messages import Topic, message, nanoseconds, serialize, time
from mrpbench_exporters_rosbag2.rmf import (
    CLOSED,
    LIFT_DOWN,
    LIFT_FOR_ROBOTS,
    LIFT_STOPPED,
    LIFT_UP,
    OPEN,
    OPENING,
    facility_types,
)
from mrpbench_exporters_rosbag2.source import Rows, Throttle, TopicSource
from mrpbench_exporters_rosbag2.template import Template, hole

INTERVAL = 0.5
"""seconds between two states of a door or lift, at least."""
DOORS = Topic("/door_states", "rmf_door_msgs/DoorState", types=facility_types())
LIFTS = Topic("/lift_states", "rmf_lift_msgs/LiftState", types=facility_types())
NUMBERS = Topic("/facilities", "std_msgs/Float64MultiArray")


def facility_numbers(world: World) -> TopicSource:
    """The channel `facility`: openings of doors and heights of cabins, in the order that the label of `dim` gives."""
    names = Facilities(world).names
    numbers = hole(len(names))
    shape = [message("std_msgs/MultiArrayDimension", label=",".join(names), size=len(names), stride=len(names))]
    layout = message("std_msgs/MultiArrayLayout", dim=shape, data_offset=0)
    template = Template(NUMBERS.type, message(NUMBERS.type, layout=layout, data=numbers), {"row": numbers})

    def rows(block: Chunk) -> Rows | None:
        return (block["time"], {"row": block["facility"]}) if "facility" in block else None

    return TopicSource(NUMBERS, template, rows)


class FacilityStates:
    """Makes the messages of Open-RMF, one per door or lift; the doors of lifts are part of their lifts."""

    def __init__(self, world: World) -> None:
        self._facilities = Facilities(world)
        self._floors = [level.name for level in world.levels]
        self._throttle = Throttle(INTERVAL)
        self._before: Mapping[str, float] = self._facilities.initial_state()

    def messages(self, block: Chunk, start: int) -> Iterator[tuple[int, Topic, bytes]]:
        """Stamp (nanoseconds), topic and bytes of each message of a block."""
        if "facility" not in block:
            return
        for index in self._throttle.due(block["time"]):
            stamp = int(nanoseconds(block["time"][index])) + start
            state = dict(zip(self._facilities.names, block["facility"][index].tolist(), strict=True))
            for operated in self._facilities.doors:
                if operated.lift is None:
                    yield stamp, DOORS, _door(stamp, operated.name, state[operated.name])
            for lift in self._facilities.lifts:
                yield stamp, LIFTS, self._lift(stamp, lift, state)
            self._before = state

    def _lift(self, stamp: int, lift: Lift, state: Mapping[str, float]) -> bytes:
        facilities, heights = self._facilities, self._facilities.heights[lift.name]
        level = facilities.level_of(lift, state)
        rise = state[lift.name] - self._before[lift.name]
        motion = LIFT_STOPPED if abs(rise) <= LEVEL_TOLERANCE else LIFT_UP if rise > 0 else LIFT_DOWN
        ahead = [stop for stop in heights if (heights[stop] - state[lift.name]) * rise > 0]
        goal = min(ahead, key=lambda stop: abs(heights[stop] - state[lift.name])) if motion and ahead else level
        doors = [state[it.name] for it in facilities.doors if it.lift is lift and level in it.opens_on]
        value = message(
            LIFTS.type,
            LIFTS.types,
            lift_time=time(stamp),
            lift_name=lift.name,
            available_floors=[self._floors[stop] for stop in lift.levels],
            current_floor=self._floors[level],
            destination_floor=self._floors[goal],
            door_state=max(map(_mode, doors), default=CLOSED),
            motion_state=motion,
            available_modes=np.array([LIFT_FOR_ROBOTS], np.uint8),
            current_mode=LIFT_FOR_ROBOTS,
            session_id="",
        )
        return serialize(LIFTS.type, value, LIFTS.types)


def _door(stamp: int, name: str, opening: float) -> bytes:
    mode = message("rmf_door_msgs/DoorMode", DOORS.types, value=_mode(opening))
    value = message(DOORS.type, DOORS.types, door_time=time(stamp), door_name=name, current_mode=mode)
    return serialize(DOORS.type, value, DOORS.types)


def _mode(opening: float) -> int:
    return CLOSED if opening <= 0 else OPEN if opening >= 1 else OPENING
