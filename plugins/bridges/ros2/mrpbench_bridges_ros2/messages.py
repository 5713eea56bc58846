"""Build ROS 2 messages from data of the execution. Frames and units are those of bags: docs/reference/bags.md."""

from array import array
from collections.abc import Iterable
from typing import Any

import numpy as np
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, TransformStamped, Vector3
from nav_msgs.msg import OccupancyGrid, Path
from nav_msgs.msg import Odometry as OdometryMessage
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header

from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Lidar
from mrpbench_core.model.worlds.world import Level

Time: Any = type(Header().stamp)
SECOND = 1_000_000_000


def header(now: float, frame: str) -> Any:
    """A header; `now` in simulated seconds."""
    return Header(stamp=stamp(now), frame_id=frame)


def stamp(now: float) -> Any:
    """A time."""
    seconds, nanoseconds = divmod(round(now * SECOND), SECOND)
    return Time(sec=seconds, nanosec=nanoseconds)


def quaternion(yaw: float) -> Any:
    """A turn about the vertical."""
    return Quaternion(z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2)))


def pose(planar: Iterable[float], z: float = 0.0) -> Any:
    """A pose from x, y, yaw."""
    x, y, yaw = map(float, planar)
    return Pose(position=Point(x=x, y=y, z=z), orientation=quaternion(yaw))


def pose_stamped(now: float, planar: Iterable[float], z: float = 0.0) -> Any:
    """A pose in `map`."""
    return PoseStamped(header=header(now, "map"), pose=pose(planar, z))


def path(now: float, waypoints: Float, z: float = 0.0) -> Any:
    """Return a path in `map` from waypoints f8[k,3] without open yaws."""
    return Path(header=header(now, "map"), poses=[pose_stamped(now, waypoint, z) for waypoint in waypoints])


def odometry(now: float, robot: str, planar: Float, twist: Float) -> Any:
    """The odometry of a robot: pose, forward speed and turn rate."""
    message = OdometryMessage(header=header(now, f"{robot}/odom"), child_frame_id=f"{robot}/base_footprint")
    message.pose.pose = pose(planar)
    message.twist.twist.linear.x, message.twist.twist.angular.z = map(float, twist)
    return message


def scan(now: float, robot: str, lidar: Lidar, ranges: Float) -> Any:
    """A scan; a beam that hits nothing reads inf (REP 117)."""
    step = 2 * np.pi / lidar.beams
    return LaserScan(
        header=header(now, f"{robot}/base_scan"),
        angle_min=0.0,
        angle_max=step * (lidar.beams - 1),
        angle_increment=step,
        scan_time=1 / lidar.rate,
        range_min=lidar.min_range,
        range_max=lidar.range,
        ranges=array("f", ranges[: lidar.beams].astype("f4").tobytes()),
    )


def transform(now: float, parent: str, child: str, planar: Iterable[float], z: float = 0.0) -> Any:
    """The transform from the frame `child` to `parent`."""
    x, y, yaw = map(float, planar)
    message = TransformStamped(header=header(now, parent), child_frame_id=child)
    message.transform.translation = Vector3(x=x, y=y, z=z)
    message.transform.rotation = quaternion(yaw)
    return message


def occupancy_grid(level: Level, resolution: float) -> Any:
    """The map of one level."""
    raster = rasterise(level, level.occupancy.resolution if level.occupancy else resolution, "touched")
    message = OccupancyGrid(header=header(0.0, "map"))
    message.info.resolution = raster.resolution
    message.info.height, message.info.width = raster.shape
    message.info.origin = pose((*raster.origin, 0.0), level.elevation)
    message.data = array("b", np.where(raster.blocked, 100, 0).astype("i1").tobytes())
    return message
