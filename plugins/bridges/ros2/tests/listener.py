"""Counts, in a separate process, the messages of a running simulation until /clock reaches SECONDS; prints JSON.

`python listener.py SECONDS ROBOT…`
"""

import json
import sys
from collections import Counter

import rclpy
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LIVE = QoSProfile(depth=1000)


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("listener")
    counts, facts = Counter(), {"stamps": [], "free": 0, "frames": set(), "ends": {}, "beams": set()}

    def clock(message):
        facts["stamps"].append(message.clock.sec + message.clock.nanosec / 1e9)

    def grid(message):
        facts["free"] = sum(cell == 0 for cell in message.data)
        facts["cells"] = message.info.width * message.info.height

    def odometry(message):
        counts[message.child_frame_id] += 1
        facts["frames"].add(message.header.frame_id)

    def scan(message):
        counts[message.header.frame_id] += 1
        facts["beams"].add(len(message.ranges))

    node.create_subscription(Clock, "/clock", clock, LIVE)
    node.create_subscription(OccupancyGrid, "/map", grid, LATCHED)
    for robot in sys.argv[2:]:
        node.create_subscription(Odometry, f"/{robot}/odom", odometry, LIVE)
        node.create_subscription(LaserScan, f"/{robot}/scan", scan, LIVE)

        def plan(message, robot=robot):
            end = message.poses[-1].pose.position
            facts["ends"][robot] = [end.x, end.y]

        node.create_subscription(Path, f"/{robot}/plan", plan, LATCHED)
    print("ready", flush=True)
    while not facts["stamps"] or facts["stamps"][-1] < float(sys.argv[1]):
        rclpy.spin_once(node, timeout_sec=1.0)
    for _ in range(200):
        rclpy.spin_once(node, timeout_sec=0.005)
    print(json.dumps({**facts, "frames": sorted(facts["frames"]), "beams": sorted(facts["beams"]), "counts": counts}))


main()
