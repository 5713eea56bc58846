"""ROS 2 messages by name, planar poses and stamps.

The definitions are those of Humble. Every type used here has the same fields, and so the same hash, up to Kilted.
"""

from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from mrpbench_core.model.common.arrays import Float, Int

TYPES = get_typestore(Stores.ROS2_HUMBLE)
SECOND = 1_000_000_000
"""nanoseconds."""


def with_types(definitions: Mapping[str, str]) -> Typestore:
    """The types of Humble, and those of definitions by full name."""
    types = get_typestore(Stores.ROS2_HUMBLE)
    for name, text in definitions.items():
        types.register(get_types_from_msg(text, name))
    return types


@attrs.frozen
class Topic:
    """A topic, its message type, whether late subscribers get its last message (transient local), and all types."""

    name: str
    type: str
    latched: bool = False
    types: Typestore = TYPES


def message(type_name: str, /, types: Typestore = TYPES, **fields: Any) -> Any:
    """Make a message; every field must be given. `std_msgs/Header` stands for `std_msgs/msg/Header`."""
    return types.types[full_name(type_name)](**fields)


def serialize(type_name: str, value: Any, types: Typestore = TYPES) -> bytes:
    """CDR bytes of a message, little-endian."""
    return bytes(types.serialize_cdr(value, full_name(type_name), little_endian=True))


def full_name(type_name: str) -> str:
    """`nav_msgs/msg/Path` for `nav_msgs/Path`."""
    return type_name.replace("/", "/msg/")


def time(stamp: int) -> Any:
    """A time from nanoseconds."""
    return message("builtin_interfaces/Time", sec=stamp // SECOND, nanosec=stamp % SECOND)


def header(stamp: int, frame: str) -> Any:
    """A header; ROS 2 has no sequence numbers."""
    return message("std_msgs/Header", stamp=time(stamp), frame_id=frame)


def point(values: ArrayLike, type_name: str = "geometry_msgs/Point") -> Any:
    """A point (or with another type name, a vector) from x, y, z."""
    x, y, z = np.asarray(values, float).tolist()
    return message(type_name, x=x, y=y, z=z)


def vector(values: ArrayLike) -> Any:
    """A vector from x, y, z."""
    return point(values, "geometry_msgs/Vector3")


def quaternion(values: ArrayLike) -> Any:
    """A quaternion from x, y, z, w."""
    x, y, z, w = np.asarray(values, float).tolist()
    return message("geometry_msgs/Quaternion", x=x, y=y, z=z, w=w)


def pose(values: Float) -> Any:
    """A pose from f8[7] as `spatial` gives them."""
    return message("geometry_msgs/Pose", position=point(values[:3]), orientation=quaternion(values[3:]))


def spatial(planar: Float, z: ArrayLike = 0.0) -> Float:
    """Position and unit quaternion f8[...,7] (x, y, z, qx, qy, qz, qw) of planar poses f8[...,3] at height `z`."""
    full = np.zeros((*planar.shape[:-1], 7))
    full[..., :2] = planar[..., :2]
    full[..., 2] = z
    full[..., 5] = np.sin(planar[..., 2] / 2)
    full[..., 6] = np.cos(planar[..., 2] / 2)
    return full


def nanoseconds(seconds: ArrayLike) -> Int:
    """Whole nanoseconds i8 nearest to `seconds`."""
    whole: Int = np.rint(np.asarray(seconds, float) * SECOND).astype(np.int64)
    return whole
