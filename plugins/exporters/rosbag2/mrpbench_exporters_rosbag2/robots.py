"""Shapes of robots, for viewers that draw neither `nav_msgs/Odometry` nor a robot description."""

import numpy as np

from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.frames import floor
from mrpbench_exporters_rosbag2.marker import CYLINDER, DARK, LINE_STRIP, TEXT, colour_of, marker
from mrpbench_exporters_rosbag2.messages import Topic, message, spatial
from mrpbench_exporters_rosbag2.source import POSE, Rows, Throttle, TopicSource
from mrpbench_exporters_rosbag2.template import Template

INTERVAL = 0.1
"""seconds between two messages, at least."""


def robot_markers(context: RunContext) -> TopicSource:
    """A cylinder, the footprint and the name of every robot where it truly is, on `/robots`."""
    topic = Topic("/robots", "visualization_msgs/MarkerArray")
    fleet = context.fleet
    named = zip(fleet.robots, fleet.names, strict=True)
    markers = [mark for index, (robot, name) in enumerate(named) for mark in _marks(index, robot, name)]
    rise = np.array([[robot.height / 2, robot.height, robot.height + 0.2] for robot in fleet.robots])
    throttle = Throttle(INTERVAL)

    def rows(block: Chunk) -> Rows | None:
        if "truth" not in block:
            return None
        shown = throttle.due(block["time"])
        planar = np.repeat(block["truth"][:, :, None], 3, axis=2)
        full = spatial(planar, floor(block, context.world)[..., None] + rise)
        return block["time"][shown], {"pose": full[shown].reshape(len(shown), 3 * len(fleet), 7)}

    return TopicSource(topic, Template(topic.type, message(topic.type, markers=markers), {"pose": POSE}), rows)


def _marks(index: int, robot: RobotModel, name: str) -> list[object]:
    """Body, outline on top of it, and name above."""
    outline = np.column_stack([robot.footprint, np.zeros(len(robot.footprint))])
    width = 2 * robot.radius
    return [
        marker("robots", index, CYLINDER, (width, width, robot.height), colour_of(index)),
        marker("footprints", index, LINE_STRIP, (0.02, 0.0, 0.0), DARK, points=[*outline, outline[0]]),
        marker("names", index, TEXT, (0.0, 0.0, 0.2), DARK, text=name),
    ]
