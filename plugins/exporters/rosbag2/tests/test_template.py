import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_exporters_rosbag2.messages import TYPES, header, message, nanoseconds, pose, serialize, spatial
from mrpbench_exporters_rosbag2.template import STAMP, Template, hole

finite = st.floats(-1e6, 1e6)


def pose_array(stamp, poses):
    """A message with one stamp and two poses of the same hole."""
    return message("geometry_msgs/PoseArray", header=header(stamp, "a frame"), poses=poses)


@given(
    stamps=st.lists(st.integers(0, 2_147_483_647_999_999_999), min_size=1, max_size=4),
    planar=st.lists(st.tuples(finite, finite, finite), min_size=8, max_size=8),
)
def test_filled_bytes_are_those_of_serialised_messages(stamps, planar):
    spot = hole(7)
    template = Template("geometry_msgs/PoseArray", pose_array(STAMP, [pose(spot), pose(spot)]), {"pose": spot})
    poses = spatial(np.array(planar)).reshape(4, 2, 7)[: len(stamps)]
    expected = [
        serialize("geometry_msgs/PoseArray", pose_array(stamp, [pose(one) for one in pair]))
        for stamp, pair in zip(stamps, poses, strict=True)
    ]
    assert template.fill(np.array(stamps), pose=poses) == expected


def test_single_precision_holes_keep_infinity():
    spot = hole(3, "<f4")
    value = message(
        "std_msgs/Float32MultiArray", layout=message("std_msgs/MultiArrayLayout", dim=[], data_offset=0), data=spot
    )
    (data,) = Template("std_msgs/Float32MultiArray", value, {"data": spot}).fill(
        np.array([0]), data=np.array([[1.5, np.inf, -2.0]])
    )
    assert list(TYPES.deserialize_cdr(data, "std_msgs/msg/Float32MultiArray").data) == [1.5, np.inf, -2.0]


@given(st.floats(-10, 10), st.floats(-10, 10), st.floats(-100, 100), st.floats(-5, 5))
def test_quaternions_are_unit_and_turn_about_z(x, y, yaw, z):
    full = spatial(np.array([x, y, yaw]), z)
    assert tuple(full[:3]) == (x, y, z)
    assert np.linalg.norm(full[3:]) == pytest.approx(1, abs=1e-12)
    turn = full[6] + 1j * full[5]
    assert turn**2 == pytest.approx(np.exp(1j * yaw), abs=1e-9)


def test_seconds_are_rounded_to_the_nearest_nanosecond():
    assert nanoseconds([0.1 + 0.2, 1e-10, 5e-10, 1.0]).tolist() == [300_000_000, 0, 0, 1_000_000_000]
