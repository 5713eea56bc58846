"""New plans during a run: `/robot_0/plan` for viewers, `/routes` with the rows of the recording for the importer."""

from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.blocks import AXES
from mrpbench_exporters_rosbag2.messages import Topic, nanoseconds
from mrpbench_exporters_rosbag2.plans import path
from mrpbench_exporters_rosbag2.whole import packed

TOPIC = Topic("/routes", "std_msgs/UInt8MultiArray")
CHANNELS = ("route_time", *AXES["route_time"])


def routes(block: Chunk, context: RunContext, start: int) -> Iterator[tuple[int, Topic, bytes]]:
    """Stamp, topic and bytes of what a block says about new plans; poses of paths are stamped when the plan came."""
    if "route_time" not in block:
        return
    for revision in np.unique(block["route_revision"]):
        rows = {name: block[name][block["route_revision"] == revision] for name in CHANNELS if name in block}
        stamp = int(nanoseconds(rows["route_time"][0])) + start
        yield stamp, TOPIC, packed(rows)
        for robot, name in enumerate(context.fleet.names):
            chosen = rows["route_robot"] == robot
            route = Route(
                waypoint=rows["route_waypoint"][chosen],
                level=rows["route_level"][chosen],
                speed=rows["route_speed"][chosen][1:],
            )
            topic, data = path(context, name, route, np.full(len(route.waypoint), stamp), stamp)
            yield stamp, topic, data
