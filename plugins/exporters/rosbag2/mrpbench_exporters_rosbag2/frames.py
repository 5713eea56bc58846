"""Moving transforms: map -> robot/odom (what localization adds) -> robot/base_footprint (odometry)."""

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World
from mrpbench_exporters_rosbag2.messages import Topic, header, message, quaternion, spatial, vector
from mrpbench_exporters_rosbag2.source import POSE, Rows, TopicSource
from mrpbench_exporters_rosbag2.template import STAMP, Template


def frames(names: tuple[str, ...], world: World) -> TopicSource:
    """All transforms of an instant as one message on `/tf`."""
    topic = Topic("/tf", "tf2_msgs/TFMessage")
    transforms = []
    for name in names:
        transforms += [transform("map", f"{name}/odom"), transform(f"{name}/odom", f"{name}/base_footprint")]

    def rows(block: Chunk) -> Rows | None:
        if "odometry" not in block or "estimate" not in block:
            return None
        driven = block["odometry"][..., :3]
        origin = spatial(parent(block["estimate"], driven), floor(block, world))
        return block["time"], {"pose": np.stack([origin, spatial(driven)], axis=2).reshape(len(driven), -1, 7)}

    return TopicSource(topic, Template(topic.type, message(topic.type, transforms=transforms), {"pose": POSE}), rows)


def transform(parent_frame: str, child_frame: str, values: Float = POSE, stamp: int = STAMP) -> object:
    """A stamped transform from f8[7] as of `spatial`."""
    return message(
        "geometry_msgs/TransformStamped",
        header=header(stamp, parent_frame),
        child_frame_id=child_frame,
        transform=message("geometry_msgs/Transform", translation=vector(values[:3]), rotation=quaternion(values[3:])),
    )


def parent(outer: Float, inner: Float) -> Float:
    """Planar pose f8[...,3] of the frame in which something stands at `inner` while it stands at `outer` outside."""
    yaw = outer[..., 2] - inner[..., 2]
    cos, sin = np.cos(yaw), np.sin(yaw)
    x = outer[..., 0] - cos * inner[..., 0] + sin * inner[..., 1]
    y = outer[..., 1] - sin * inner[..., 0] - cos * inner[..., 1]
    return np.stack([x, y, yaw], axis=-1)


def floor(block: Chunk, world: World, robots: int | slice = slice(None)) -> Float:
    """Height f8[k,n] (of one robot f8[k]) of the floor, metres; the first level's where levels are not recorded."""
    elevation = np.array([level.elevation for level in world.levels])
    heights: Float = elevation[block["level"][:, robots]] if "level" in block else elevation[:1]
    return heights
