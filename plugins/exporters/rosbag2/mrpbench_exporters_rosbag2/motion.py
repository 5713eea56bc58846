"""Motion of each robot: odometry, ground truth, estimates and commands."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World
from mrpbench_exporters_rosbag2.covariances import Covariances
from mrpbench_exporters_rosbag2.frames import floor
from mrpbench_exporters_rosbag2.messages import Topic, header, message, pose, spatial, vector
from mrpbench_exporters_rosbag2.source import COVARIANCE, POSE, TWIST, Rows, Throttle, TopicSource
from mrpbench_exporters_rosbag2.template import STAMP, Template

INTERVAL = 0.5
"""seconds between two estimates, at least: AMCL estimates a pose where the robot has moved, not in every period."""


def odometry(robot: int, name: str, covariances: Covariances) -> TopicSource:
    """Odometry of the robot, with covariances of its pose and twist."""

    def rows(block: Chunk) -> Rows | None:
        if "odometry" not in block:
            return None
        values = block["odometry"][:, robot]
        spread = covariances.of(block)
        return block["time"], {
            "pose": spatial(values[:, :3]),
            "twist": twist(values[:, 3:]),
            "covariance": np.stack([_of(spread.odometry, robot), _of(spread.twist, robot)], axis=1),
        }

    topic = Topic(f"/{name}/odom", "nav_msgs/Odometry")
    return TopicSource(topic, _odometry(topic, f"{name}/odom", f"{name}/base_footprint", COVARIANCE), rows)


def amcl_pose(robot: int, name: str, world: World, covariances: Covariances) -> TopicSource:
    """The robot's estimate of its pose, with its covariance, as AMCL publishes it."""
    throttle = Throttle(INTERVAL)

    def rows(block: Chunk) -> Rows | None:
        if "estimate" not in block:
            return None
        spread, shown = _of(covariances.of(block).estimate, robot), throttle.due(block["time"])
        full = spatial(block["estimate"][:, robot], floor(block, world, robot))
        return block["time"][shown], {"pose": full[shown], "covariance": spread[shown]}

    topic = Topic(f"/{name}/amcl_pose", "geometry_msgs/PoseWithCovarianceStamped")
    estimated = message("geometry_msgs/PoseWithCovariance", pose=pose(POSE), covariance=COVARIANCE)
    value = message(topic.type, header=header(STAMP, "map"), pose=estimated)
    return TopicSource(topic, Template(topic.type, value, {"pose": POSE, "covariance": COVARIANCE}), rows)


def _of(covariances: Float, robot: int) -> Float:
    """Those of one robot f8[k,36]; one for all where nothing is known."""
    return covariances[:, min(robot, covariances.shape[1] - 1)]


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


EXACT = np.zeros(36)
"""The covariance of the ground truth."""


def _odometry(topic: Topic, frame: str, child: str, covariance: Float = EXACT) -> Template:
    value = message(
        topic.type,
        header=header(STAMP, frame),
        child_frame_id=child,
        pose=message("geometry_msgs/PoseWithCovariance", pose=pose(POSE), covariance=covariance),
        twist=message("geometry_msgs/TwistWithCovariance", twist=_twist(), covariance=covariance),
    )
    varying = {"covariance": COVARIANCE} if covariance is COVARIANCE else {}
    return Template(topic.type, value, {"pose": POSE, "twist": TWIST, **varying})
