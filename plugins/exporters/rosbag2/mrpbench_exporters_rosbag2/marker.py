"""Messages with shapes, `visualization_msgs/Marker`, which every viewer of ROS draws."""

import colorsys

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_exporters_rosbag2.messages import header, message, point, pose, vector
from mrpbench_exporters_rosbag2.source import POSE
from mrpbench_exporters_rosbag2.template import STAMP

ARROW, CYLINDER, LINE_STRIP, LINE_LIST, TEXT = 0, 3, 4, 5, 9
"""Types of `visualization_msgs/Marker`."""
ADD, DELETE = 0, 2
"""Its actions."""
Colour = tuple[float, float, float, float]
"""Red, green, blue, alpha."""
DARK = (0.1, 0.1, 0.1, 1.0)


def colour_of(robot: int) -> Colour:
    """A colour that differs from those of robots with close numbers: hues by the golden ratio."""
    red, green, blue = colorsys.hsv_to_rgb(robot * 0.618034 % 1, 0.75, 0.9)
    return red, green, blue, 0.7


def marker(
    namespace: str,
    number: int,
    kind: int,
    scale: tuple[float, float, float],
    colour: Colour,
    *,
    points: list[Float] | tuple[()] = (),
    text: str = "",
    values: Float = POSE,
    stamp: int = STAMP,
    action: int = ADD,
) -> object:
    """A marker in `map` that stays until another with the same namespace and number replaces it."""
    red, green, blue, alpha = colour
    return message(
        "visualization_msgs/Marker",
        header=header(stamp, "map"),
        ns=namespace,
        id=number,
        type=kind,
        action=action,
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
