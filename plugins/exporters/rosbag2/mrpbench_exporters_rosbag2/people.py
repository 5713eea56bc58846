"""People and other movers: `/people` as `people_msgs`, `/people_markers` for viewers, and `/movers`, the exact numbers.

ROS itself does not have `people_msgs` (https://docs.ros.org/en/humble/p/people_msgs); its definition is in the bag.
"""

from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.marker import ADD, ARROW, CYLINDER, DARK, DELETE, TEXT, marker
from mrpbench_exporters_rosbag2.messages import Topic, header, message, point, spatial, with_types
from mrpbench_exporters_rosbag2.source import POSE, Rows, Throttle, TopicSource, Varying
from mrpbench_exporters_rosbag2.template import STAMP, Template, hole

INTERVAL = 0.1
"""seconds between two messages of `/people` or `/people_markers`, at least."""
HEIGHT = {"person": 1.7}
"""Metres of cylinders, by kind."""
LOW = 1.0
"""Metres of cylinders of other kinds."""
COLOUR = (0.55, 0.6, 0.65, 0.8)
COLUMNS = ("x", "y", "yaw", "vx", "vy", "level", "arrivals")
"""Of a mover on `/movers`: the channels `mover`, `mover_level` and `mover_arrivals`."""
PLACE, VELOCITY = hole(3), hole(4)[:3]
NOWHERE = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
DEFINITIONS = {
    "people_msgs/msg/Person": "string name\ngeometry_msgs/Point position\ngeometry_msgs/Point velocity\n"
    "float64 reliability\nstring[] tagnames\nstring[] tags\n",
    "people_msgs/msg/People": "std_msgs/Header header\nPerson[] people\n",
}
"""The same from ROS 1 to Rolling."""


PEOPLE = Topic("/people", "people_msgs/People", types=with_types(DEFINITIONS))
MARKERS = Topic("/people_markers", "visualization_msgs/MarkerArray")
NUMBERS = Topic("/movers", "std_msgs/Float64MultiArray")


def mover_numbers(context: RunContext) -> TopicSource:
    """Where all movers are at every sample, absent ones included. Its stamp is the log time."""
    count, width = len(context.movers), len(COLUMNS)
    numbers = hole(count * width)
    shape = [
        message("std_msgs/MultiArrayDimension", label=",".join(context.mover_names), size=count, stride=count * width),
        message("std_msgs/MultiArrayDimension", label=",".join(COLUMNS), size=width, stride=width),
    ]
    layout = message("std_msgs/MultiArrayLayout", dim=shape, data_offset=0)

    def rows(block: Chunk) -> Rows | None:
        if "mover" not in block:
            return None
        level = block["mover_level"]
        arrivals = block.get("mover_arrivals", np.full_like(level, -1))  # older recordings lack them
        table = np.concatenate([block["mover"], level[..., None], arrivals[..., None]], axis=2)
        return block["time"], {"row": table.reshape(len(table), -1)}

    template = Template(NUMBERS.type, message(NUMBERS.type, layout=layout, data=numbers), {"row": numbers})
    return TopicSource(NUMBERS, template, rows)


def people(context: RunContext) -> TopicSource:
    """Name, place and velocity of each mover that is there; its kind is a tag."""
    types = PEOPLE.types
    named = list(zip(context.movers, context.mover_names, strict=True))

    def template(there: tuple[bool, ...]) -> _Present:
        present = [
            message(
                "people_msgs/Person",
                types,
                name=name,
                position=point(PLACE),
                velocity=point(VELOCITY),
                reliability=1.0,
                tagnames=["kind"],
                tags=[mover.kind],
            )
            for (mover, name), shown in zip(named, there, strict=True)
            if shown
        ]
        value = message(PEOPLE.type, types, header=header(STAMP, "map"), people=present)
        return _Present(there, Template(PEOPLE.type, value, {"place": PLACE, "velocity": VELOCITY}, types))

    def values(mover: Float, height: Float) -> dict[str, Float]:
        x, y, _, vx, vy = np.moveaxis(mover, 2, 0)
        return {"place": np.stack([x, y, height], axis=2), "velocity": np.stack([vx, vy, np.zeros_like(vx)], axis=2)}

    return TopicSource(PEOPLE, Varying("there", template), _throttled(context, values))


def people_markers(context: RunContext) -> TopicSource:
    """Body, heading and name of each mover; those of absent ones are deleted."""
    named = list(zip(context.movers, context.mover_names, strict=True))
    tall = np.array([HEIGHT.get(mover.kind, LOW) for mover in context.movers])
    rise = np.column_stack([tall / 2, tall, tall + 0.2])

    def template(there: tuple[bool, ...]) -> _Present:
        marks = [
            mark
            for index, ((mover, name), shown) in enumerate(zip(named, there, strict=True))
            for mark in _marks(index, mover, name, tall[index], shown=shown)
        ]
        return _Present(there, Template(MARKERS.type, message(MARKERS.type, markers=marks), {"pose": POSE}))

    def values(mover: Float, height: Float) -> dict[str, Float]:
        return {"pose": spatial(np.repeat(mover[:, :, None, :3], 3, axis=2), height[..., None] + rise)}

    return TopicSource(MARKERS, Varying("there", template), _throttled(context, values))


@attrs.frozen
class _Present:
    """A template for the movers that are there."""

    there: tuple[bool, ...]
    template: Template

    def fill(self, stamps: Int, **values: NDArray[Any]) -> list[bytes]:
        """One message for each of `stamps`; values [k,m,...] are those of all movers."""
        present = {name: rows[:, np.array(self.there)] for name, rows in values.items()}
        return self.template.fill(stamps, **(present if any(self.there) else {}))


def _throttled(
    context: RunContext, values: Callable[[Float, Float], dict[str, Float]]
) -> Callable[[Chunk], Rows | None]:
    """Rows of `values` of the channel `mover` f8[k,m,5] and the heights f8[k,m] of the floors, metres."""
    throttle, elevation = Throttle(INTERVAL), np.array([level.elevation for level in context.world.levels])

    def rows(block: Chunk) -> Rows | None:
        if "mover" not in block:
            return None
        shown = throttle.due(block["time"])
        level = block["mover_level"][shown]
        return block["time"][shown], {**values(block["mover"][shown], elevation[level]), "there": level >= 0}

    return rows


def _marks(index: int, mover: Mover, name: str, height: float, *, shown: bool) -> list[object]:
    width = 2 * mover.radius
    pose, action = (POSE, ADD) if shown else (NOWHERE, DELETE)
    return [
        marker("people", index, CYLINDER, (width, width, height), COLOUR, values=pose, action=action),
        marker("headings", index, ARROW, (width, 0.08, 0.08), DARK, values=pose, action=action),
        marker("names", index, TEXT, (0.0, 0.0, 0.2), DARK, text=name, values=pose, action=action),
    ]
