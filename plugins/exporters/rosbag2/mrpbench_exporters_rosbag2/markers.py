"""Robots as shapes, for viewers that draw neither `nav_msgs/Odometry` nor a robot description."""

import colorsys

import numpy as np

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.recording import Chunk
from mrpbench_core.model.run import RunContext
from mrpbench_exporters_rosbag2.frames import floor
from mrpbench_exporters_rosbag2.messages import Topic, header, message, point, pose, spatial, vector
from mrpbench_exporters_rosbag2.source import POSE, Rows, Source
from mrpbench_exporters_rosbag2.template import STAMP, Template

INTERVAL = 0.1
"""seconds between two messages, at least."""
CYLINDER, LINE_STRIP, TEXT = 3, 4, 9
"""Types of `visualization_msgs/Marker`."""


def robots(context: RunContext) -> Source:
    """A cylinder, the footprint and the name of every robot where it truly is, on `/robots`."""
    topic = Topic("/robots", "visualization_msgs/MarkerArray")
    fleet = context.fleet
    markers = [mark for index, robot in enumerate(fleet.robots) for mark in _marks(index, robot, fleet.names[index])]
    rise = np.array([[robot.height / 2, robot.height, robot.height + 0.2] for robot in fleet.robots])
    due = -np.inf

    def rows(block: Chunk) -> Rows | None:
        nonlocal due
        if "truth" not in block:
            return None
        shown = []
        for index, now in enumerate(block["time"].tolist()):
            if now >= due:
                shown.append(index)
                due = now + INTERVAL - 1e-9
        planar = np.repeat(block["truth"][:, :, None], 3, axis=2)
        full = spatial(planar, floor(block, context.world)[..., None] + rise)
        return block["time"][shown], {"pose": full[shown].reshape(len(shown), 3 * len(fleet), 7)}

    return Source(topic, Template(topic.type, message(topic.type, markers=markers), {"pose": POSE}), rows)


def _marks(index: int, robot: RobotModel, name: str) -> list[object]:
    """Body, outline on top of it, and name above."""
    red, green, blue = colorsys.hsv_to_rgb(index * 0.618034 % 1, 0.75, 0.9)  # golden ratio: neighbours differ
    outline = np.column_stack([robot.footprint, np.zeros(len(robot.footprint))])
    colour = (red, green, blue, 0.7)
    return [
        marker("robots", index, CYLINDER, (2 * robot.radius, 2 * robot.radius, robot.height), colour),
        marker("footprints", index, LINE_STRIP, (0.02, 0.0, 0.0), (0.1, 0.1, 0.1, 1.0), points=[*outline, outline[0]]),
        marker("names", index, TEXT, (0.0, 0.0, 0.2), (0.1, 0.1, 0.1, 1.0), text=name),
    ]


def marker(
    namespace: str,
    number: int,
    kind: int,
    scale: tuple[float, float, float],
    colour: tuple[float, float, float, float],
    points: list[Float] | tuple[()] = (),
    text: str = "",
    values: Float = POSE,
    stamp: int = STAMP,
) -> object:
    """A marker in `map` that stays until another with the same namespace and number replaces it."""
    red, green, blue, alpha = colour
    return message(
        "visualization_msgs/Marker",
        header=header(stamp, "map"),
        ns=namespace,
        id=number,
        type=kind,
        action=0,
        pose=pose(values),
        scale=vector(scale),
        color=message("std_msgs/ColorRGBA", r=red, g=green, b=blue, a=alpha),
        lifetime=message("builtin_interfaces/Duration", sec=0, nanosec=0),
        frame_locked=False,
        points=[point(values) for values in points],
        colors=[],
        texture_resource="",
        texture=message("sensor_msgs/CompressedImage", header=header(0, ""), format="", data=np.zeros(0, np.uint8)),
        uv_coordinates=[],
        text=text,
        mesh_resource="",
        mesh_file=message("visualization_msgs/MeshFile", filename="", data=np.zeros(0, np.uint8)),
        mesh_use_embedded_materials=False,
    )
