"""Bags as other stacks record them, written with the types of the distribution that is asked for."""

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SECOND = 10**9
RMF = {
    "rmf_fleet_msgs/msg/Location": "builtin_interfaces/Time t\nfloat32 x\nfloat32 y\nfloat32 yaw\nstring level_name\n"
    "uint64 index\n",
    "rmf_fleet_msgs/msg/RobotMode": "uint32 MODE_IDLE=0\nuint32 MODE_MOVING=2\nuint32 mode\nuint64 mode_request_id\n",
    "rmf_fleet_msgs/msg/RobotState": "string name\nstring model\nstring task_id\nuint64 seq\n"
    "rmf_fleet_msgs/RobotMode mode\nfloat32 battery_percent\nrmf_fleet_msgs/Location location\n"
    "rmf_fleet_msgs/Location[] path\n",
    "rmf_fleet_msgs/msg/FleetState": "string name\nrmf_fleet_msgs/RobotState[] robots\n",
}


class Foreign:
    """Writes one bag."""

    def __init__(self, path, storage="mcap", distribution=Stores.ROS2_JAZZY, version=9):
        self.types = get_typestore(distribution)
        for name, text in RMF.items():
            self.types.register(get_types_from_msg(text, name))
        self.path = path
        self.writer = Writer(path, version=version, storage_plugin=StoragePlugin[storage.upper()])
        self.said = []

    def make(self, kind, /, **fields):
        return self.types.types[kind.replace("/", "/msg/")](**fields)

    def say(self, topic, name, message, log):
        self.said.append((round(log * SECOND), topic, name.replace("/", "/msg/"), message))

    def close(self):
        connections = {}
        with self.writer:
            for log, topic, name, message in sorted(self.said, key=lambda said: said[0]):
                if topic not in connections:
                    connections[topic] = self.writer.add_connection(topic, name, typestore=self.types)
                self.writer.write(connections[topic], log, self.types.serialize_cdr(message, name))
        return self.path

    def time(self, seconds):
        stamp = round(seconds * SECOND)
        return self.make("builtin_interfaces/Time", sec=stamp // SECOND, nanosec=stamp % SECOND)

    def header(self, seconds, frame):
        return self.make("std_msgs/Header", stamp=self.time(seconds), frame_id=frame)

    def pose(self, x, y, yaw):
        turn = self.make("geometry_msgs/Quaternion", x=0.0, y=0.0, z=np.sin(yaw / 2), w=np.cos(yaw / 2))
        return self.make("geometry_msgs/Pose", position=self.point("Point", x, y), orientation=turn)

    def point(self, name, x, y):
        return self.make(f"geometry_msgs/{name}", x=float(x), y=float(y), z=0.0)

    def moving(self, speed, turn_rate):
        linear, angular = self.point("Vector3", speed, 0), self.point("Vector3", 0, 0)
        angular.z = float(turn_rate)
        return self.make("geometry_msgs/Twist", linear=linear, angular=angular)

    def twist(self, topic, log, speed, turn_rate):
        self.say(topic, "geometry_msgs/Twist", self.moving(speed, turn_rate), log)

    def scan(self, topic, stamp, ranges, log=None):
        message = self.make(
            "sensor_msgs/LaserScan",
            header=self.header(stamp, "base_scan"),
            angle_min=0.0,
            angle_max=3.0,
            angle_increment=1.0,
            time_increment=0.0,
            scan_time=0.1,
            range_min=0.1,
            range_max=3.5,
            ranges=np.array(ranges, np.float32),
            intensities=np.zeros(0, np.float32),
        )
        self.say(topic, "sensor_msgs/LaserScan", message, stamp if log is None else log)

    def odometry(self, topic, stamp, x, y, yaw, *, frame="odom", log=None, speed=(0.0, 0.0)):
        message = self.make(
            "nav_msgs/Odometry",
            header=self.header(stamp, frame),
            child_frame_id="base_footprint",
            pose=self.make("geometry_msgs/PoseWithCovariance", pose=self.pose(x, y, yaw), covariance=np.zeros(36)),
            twist=self.make("geometry_msgs/TwistWithCovariance", twist=self.moving(*speed), covariance=np.zeros(36)),
        )
        self.say(topic, "nav_msgs/Odometry", message, stamp if log is None else log)

    def amcl(self, topic, stamp, x, y, yaw, log=None):
        message = self.make(
            "geometry_msgs/PoseWithCovarianceStamped",
            header=self.header(stamp, "map"),
            pose=self.make("geometry_msgs/PoseWithCovariance", pose=self.pose(x, y, yaw), covariance=np.zeros(36)),
        )
        self.say(topic, "geometry_msgs/PoseWithCovarianceStamped", message, stamp if log is None else log)

    def transform(self, topic, stamp, parent, child, x, y, yaw, *, log=None):
        at = self.pose(x, y, yaw)
        said = self.make(
            "geometry_msgs/TransformStamped",
            header=self.header(stamp, parent),
            child_frame_id=child,
            transform=self.make(
                "geometry_msgs/Transform", translation=self.point("Vector3", x, y), rotation=at.orientation
            ),
        )
        self.say(
            topic,
            "tf2_msgs/TFMessage",
            self.make("tf2_msgs/TFMessage", transforms=[said]),
            stamp if log is None else log,
        )

    def fleet(self, stamp, robots, name="tinyRobot", level="L1", topic="/fleet_states"):
        states = []
        for robot, (x, y, yaw) in robots.items():
            place = self.make(
                "rmf_fleet_msgs/Location", t=self.time(stamp), x=x, y=y, yaw=yaw, level_name=level, index=0
            )
            mode = self.make("rmf_fleet_msgs/RobotMode", MODE_IDLE=0, MODE_MOVING=2, mode=2, mode_request_id=0)
            states.append(
                self.make(
                    "rmf_fleet_msgs/RobotState",
                    name=robot,
                    model="",
                    task_id="",
                    seq=0,
                    mode=mode,
                    battery_percent=1.0,
                    location=place,
                    path=[],
                )
            )
        message = self.make("rmf_fleet_msgs/FleetState", name=name, robots=states)
        self.say(topic, "rmf_fleet_msgs/FleetState", message, stamp)
