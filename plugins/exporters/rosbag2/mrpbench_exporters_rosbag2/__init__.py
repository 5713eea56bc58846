"""The format `rosbag2`."""

from mrpbench_exporters_rosbag2.rosbag2 import Rosbag2

__all__ = ["Rosbag2"]
