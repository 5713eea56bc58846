"""Every message of a bag that mrpbench wrote, read by ROS's own type support."""

import importlib
import sqlite3
from pathlib import Path

import pytest

from mrpbench_core import run

MAP = "type octile\nheight 6\nwidth 8\nmap\n" + "........\n" * 6
NOT_ON_PYPI = {"tf2_msgs", "rmf_fleet_msgs"}


@pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")  # a parser that ROS brings along
def test_ros_reads_every_message_and_writes_the_same(tmp_path, monkeypatch):
    serialization = pytest.importorskip("rclpy.serialization", reason="ROS 2 is not here: see docs/how-to/live-ros.md")
    typesys = pytest.importorskip("rosbags.typesys")
    types = typesys.get_typestore(typesys.Stores.ROS2_KILTED)
    monkeypatch.chdir(tmp_path)
    Path("free.map").write_text(MAP)
    (record,) = run(
        {
            "name": "exported",
            "world": {"plugin": "movingai", "file": "free.map"},
            "roadmap": "grid",
            "fleet": [{"robot": "turtlebot3_burger", "lidar": {"beams": 30, "range": 3.5}}],
            "scenario": {"plugin": "random", "robots": 2},
            "assigner": "identity",
            "planner": "example",
            "metrics": [],
            "limits": {"execution": "3 s"},
            "export": [{"plugin": "rosbag2", "storage": "sqlite3"}],
        }
    )
    (bag,) = Path(f"results/exported/exports/{record['run_id']}").glob("*/*.db3")
    with sqlite3.connect(bag) as database:
        rows = database.execute("SELECT name, type, data FROM messages JOIN topics ON topics.id = topic_id").fetchall()
    database.close()
    read, absent = set(), set()
    for topic, name, data in rows:
        package, _, kind = name.split("/")
        try:
            message_type = getattr(importlib.import_module(f"{package}.msg"), kind)
        except ImportError:
            absent.add(package)
            continue
        message = serialization.deserialize_message(data, message_type)
        again = serialization.serialize_message(message)  # its padding is not initialised
        assert types.serialize_cdr(types.deserialize_cdr(again, name), name) == data, topic
        read.add(package)
    assert absent <= NOT_ON_PYPI
    assert {"nav_msgs", "sensor_msgs", "geometry_msgs", "rosgraph_msgs", "std_msgs"} <= read
