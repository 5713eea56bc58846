"""An external stack in a separate process: drives every robot along its released path.

`python outside.py MODE ROBOT…`: `drive` drives; `mute` says twenty times, for a second, to turn, and then nothing more.
It knows nothing of mrpbench: paths and odometry come, and commands go, over ROS alone.
"""

import math
import sys

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry, Path
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Driver:
    """Turns to the next point of the path, then drives to it."""

    def __init__(self, node: Node, robot: str, mute: bool) -> None:
        self.points: list[tuple[float, float]] = []
        self.mute = mute
        self.spoken = 0
        self.commands = node.create_publisher(Twist, f"/{robot}/cmd_vel", 1)
        node.create_subscription(Path, f"/{robot}/released", self.follow, LATCHED)
        node.create_subscription(Odometry, f"/{robot}/odom", self.drive, 1)

    def follow(self, path: Path) -> None:
        self.points = [(pose.pose.position.x, pose.pose.position.y) for pose in path.poses]

    def drive(self, odometry: Odometry) -> None:
        place, turn = odometry.pose.pose.position, odometry.pose.pose.orientation
        if self.mute:
            if self.points and self.spoken < 20:
                self.say(0.0, 0.5)
            return
        while len(self.points) > 1 and math.dist((place.x, place.y), self.points[0]) < 0.05:
            self.points.pop(0)
        if not self.points:
            return
        x, y = self.points[0]
        far = math.dist((place.x, place.y), (x, y))
        error = math.remainder(math.atan2(y - place.y, x - place.x) - 2 * math.atan2(turn.z, turn.w), math.tau)
        if far < 0.02:
            self.say(0.0, 0.0)
        else:
            self.say(min(0.2, far) if abs(error) < 0.3 else 0.0, max(-1.5, min(1.5, 3 * error)))

    def say(self, speed: float, turn: float) -> None:
        self.spoken += 1
        twist = Twist()
        twist.linear.x, twist.angular.z = speed, turn
        self.commands.publish(twist)


def main() -> None:
    rclpy.init()
    node = rclpy.create_node("outside")
    drivers = [Driver(node, robot, sys.argv[1] == "mute") for robot in sys.argv[2:]]
    assert drivers
    rclpy.spin(node)


main()
