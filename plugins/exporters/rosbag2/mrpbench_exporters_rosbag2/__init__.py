"""Writes runs as rosbag2 bags."""

from mrpbench_exporters_rosbag2.exporter import Rosbag2

__all__ = ["Rosbag2"]
