"""Motion of each robot: odometry, ground truth and commands."""

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.recording import Chunk
from mrpbench_core.model.world import World
from mrpbench_exporters_rosbag2.frames import floor
from mrpbench_exporters_rosbag2.messages import Topic, header, message, pose, spatial, vector
from mrpbench_exporters_rosbag2.source import POSE, TWIST, Rows, TopicSource
from mrpbench_exporters_rosbag2.template import STAMP, Template


def odometry(robot: int, name: str) -> TopicSource:
    """Odometry of the robot."""

    def rows(block: Chunk) -> Rows | None:
        if "odometry" not in block:
            return None
        values = block["odometry"][:, robot]
        return block["time"], {"pose": spatial(values[:, :3]), "twist": twist(values[:, 3:])}

    topic = Topic(f"/{name}/odom", "nav_msgs/Odometry")
    return TopicSource(topic, _odometry(topic, f"{name}/odom", f"{name}/base_footprint"), rows)


def ground_truth(robot: int, name: str, world: World) -> TopicSource:
    """True pose of the robot. It is not a transform, because the robot's frames follow its estimate."""

    def rows(block: Chunk) -> Rows | None:
        if "truth" not in block or "truth_twist" not in block:
            return None
        full = spatial(block["truth"][:, robot], floor(block, world, robot))
        return block["time"], {"pose": full, "twist": twist(block["truth_twist"][:, robot])}

    topic = Topic(f"/{name}/ground_truth", "nav_msgs/Odometry")
    return TopicSource(topic, _odometry(topic, "map", f"{name}/base_footprint"), rows)


def command(robot: int, name: str) -> TopicSource:
    """Commands that the robot received."""

    def rows(block: Chunk) -> Rows | None:
        return (block["time"], {"twist": twist(block["command"][:, robot])}) if "command" in block else None

    topic = Topic(f"/{name}/cmd_vel", "geometry_msgs/Twist")
    return TopicSource(topic, Template(topic.type, _twist(), {"twist": TWIST}), rows)


def twist(values: Float) -> Float:
    """Linear and angular velocity f8[k,6] of forward speed and turn rate f8[k,2]."""
    full = np.zeros((len(values), 6))
    full[:, [0, 5]] = values
    return full


def _twist() -> object:
    return message("geometry_msgs/Twist", linear=vector(TWIST[:3]), angular=vector(TWIST[3:]))


def _odometry(topic: Topic, frame: str, child: str) -> Template:
    exact = np.zeros(36)
    value = message(
        topic.type,
        header=header(STAMP, frame),
        child_frame_id=child,
        pose=message("geometry_msgs/PoseWithCovariance", pose=pose(POSE), covariance=exact),
        twist=message("geometry_msgs/TwistWithCovariance", twist=_twist(), covariance=exact),
    )
    return Template(topic.type, value, {"pose": POSE, "twist": TWIST})
