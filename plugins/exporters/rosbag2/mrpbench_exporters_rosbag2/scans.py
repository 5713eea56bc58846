"""The messages with lidar scans, `sensor_msgs/LaserScan`."""

import numpy as np

from mrpbench_core.model.common.fleet import Lidar
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_exporters_rosbag2.messages import Topic, header, message
from mrpbench_exporters_rosbag2.source import Rows, TopicSource
from mrpbench_exporters_rosbag2.template import STAMP, Template, hole


def scan(robot: int, name: str, lidar: Lidar) -> TopicSource:
    """One robot's scans. A scan is taken at one instant; a beam that hits nothing reads inf (REP 117)."""
    topic = Topic(f"/{name}/scan", "sensor_msgs/LaserScan")
    ranges = hole(lidar.beams, "<f4")
    step = 2 * np.pi / lidar.beams
    value = message(
        topic.type,
        header=header(STAMP, f"{name}/base_scan"),
        angle_min=0.0,
        angle_max=step * (lidar.beams - 1),
        angle_increment=step,
        time_increment=0.0,
        scan_time=1 / lidar.rate,
        range_min=lidar.min_range,
        range_max=lidar.range,
        ranges=ranges,
        intensities=np.zeros(0, np.float32),
    )

    def rows(block: Chunk) -> Rows | None:
        if "scan_ranges" not in block:
            return None
        chosen = block["scan_robot"] == robot
        return block["scan_time"][chosen], {"ranges": block["scan_ranges"][chosen, : lidar.beams]}

    return TopicSource(topic, Template(topic.type, value, {"ranges": ranges}), rows)
