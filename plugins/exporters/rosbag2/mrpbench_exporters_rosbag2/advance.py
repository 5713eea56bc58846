"""Progress of the robots on `/progress`, one row of numbers per robot; ROS has no message for it."""

import numpy as np

from mrpbench_core.model.runs.recording import Chunk
from mrpbench_exporters_rosbag2.messages import Topic, message
from mrpbench_exporters_rosbag2.source import Rows, TopicSource
from mrpbench_exporters_rosbag2.template import Template, hole

TOPIC = Topic("/progress", "std_msgs/Float64MultiArray")
CHANNELS = ("released", "reached", "cleared", "mode", "level")
"""The columns."""


def advance(robots: int) -> TopicSource:
    """Path segments released, reached and cleared, mode, and level of every robot. Its stamp is the log time."""
    width = len(CHANNELS)
    numbers = hole(width * robots)
    shape = [
        message("std_msgs/MultiArrayDimension", label="robot", size=robots, stride=width * robots),
        message("std_msgs/MultiArrayDimension", label=",".join(CHANNELS), size=width, stride=width),
    ]
    layout = message("std_msgs/MultiArrayLayout", dim=shape, data_offset=0)

    def rows(block: Chunk) -> Rows | None:
        if not all(name in block for name in CHANNELS):
            return None
        table = np.stack([block[name].astype(float) for name in CHANNELS], axis=-1)
        return block["time"], {"row": table.reshape(len(table), -1)}

    return TopicSource(
        TOPIC, Template(TOPIC.type, message(TOPIC.type, layout=layout, data=numbers), {"row": numbers}), rows
    )
