"""Doors, lifts and covariances in bags, as ROS's libraries and our importer read them."""

import attrs
import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2
from rosbags.highlevel import AnyReader

from mrpbench_core.model.worlds.world import Door, Level, Lift

PLANAR = np.ix_((0, 1, 5), (0, 1, 5))


@pytest.fixture
def house(context):
    """The room with a door, a second floor and a lift with a door of its own."""
    (room,) = context.world.levels
    room = attrs.evolve(room, doors=(Door(name="gate", start=(3, 1), end=(3, 2)),))
    hatch = Door(name="hatch", start=(5, 3), end=(5.5, 3))
    lift = Lift(
        name="lift",
        x=5.25,
        y=3.5,
        yaw=0.0,
        width=0.5,
        depth=0.5,
        levels=(0, 1),
        initial_level=0,
        doors=(hatch,),
        door_levels=((0, 1),),
    )
    upper = Level(name="L2", elevation=4.5, walls=room.walls)
    return attrs.evolve(context, world=attrs.evolve(context.world, levels=(room, upper), lifts=(lift,)))


@pytest.fixture
def moving(recording):
    """The recording with a gate that opens in 2 s, and a lift that closes its door, rises, and opens it again."""
    time = recording["time"]
    gate = np.clip(time / 2, 0, 1)
    hatch = np.clip(np.maximum(1 - time, time - 3), 0, 1)
    height = np.clip(0.5 + 2 * (time - 1), 0.5, 4.5)
    return recording | {"facility": np.stack([gate, hatch, height], axis=1)}


def written(context, chunk, destination, **options):
    session = Rosbag2(**options).open(context, destination)
    session.write(chunk)
    session.close()
    return destination


def test_doors_and_lifts_are_states_of_open_rmf(house, moving, tmp_path, read):
    bag = read(written(house, moving, tmp_path / "bag"))
    doors = [message for _, message in bag["/door_states"]]
    assert {message.door_name for message in doors} == {"gate"}
    assert [message.current_mode.value for message in doors] == [0, 1, 1, 1, 2, 2, 2, 2, 2]
    lifts = [message for _, message in bag["/lift_states"]]
    assert {(message.lift_name, tuple(message.available_floors)) for message in lifts} == {("lift", ("L1", "L2"))}
    assert [message.door_state for message in lifts] == [2, 1, 0, 0, 0, 0, 0, 1, 2]
    assert [message.motion_state for message in lifts] == [0, 0, 0, 1, 1, 1, 1, 0, 0]
    assert [message.current_floor for message in lifts] == ["L1"] * 4 + ["L2"] * 5 or lifts[4].current_floor == "L1"
    assert lifts[3].destination_floor == "L2"
    stamps = [message.lift_time.sec + message.lift_time.nanosec / 1e9 for message in lifts]
    assert stamps == pytest.approx(np.arange(9) / 2)


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_the_states_come_back_through_rosbags_and_our_importer(house, moving, tmp_path, storage):
    bag = written(house, moving, tmp_path / "bag", storage=storage)
    with AnyReader([bag]) as reader:
        kinds = {connection.topic: connection.msgtype for connection in reader.connections}
        wanted = [found for found in reader.connections if found.topic in ("/door_states", "/robot_0/amcl_pose")]
        read = [(found.topic, reader.deserialize(data, found.msgtype)) for found, _, data in reader.messages(wanted)]
    assert kinds["/door_states"] == "rmf_door_msgs/msg/DoorState"
    assert kinds["/lift_states"] == "rmf_lift_msgs/msg/LiftState"
    assert kinds["/robot_0/amcl_pose"] == "geometry_msgs/msg/PoseWithCovarianceStamped"
    assert len(read) == 18
    observed = Rosbag2().read(bag)
    assert np.array_equal(observed.channels["facility"], moving["facility"])
    assert observed.notes == ()


def test_covariances_are_the_mean_squared_errors_so_far(house, moving, tmp_path, read):
    error = moving["estimate"] - moving["truth"]
    error[..., 0] += 0.1 * np.sin(moving["time"])[:, None]
    chunk = moving | {"estimate": moving["truth"] + error}
    bag = read(written(house, chunk, tmp_path / "bag"))
    for robot in (0, 1):
        times = [stamp / 1e9 for stamp, _ in bag[f"/robot_{robot}/amcl_pose"]]
        rows = np.searchsorted(moving["time"], np.array(times) - 1e-9)
        for row, (_, message) in zip(rows, bag[f"/robot_{robot}/amcl_pose"], strict=True):
            covariance = np.array(message.pose.covariance).reshape(6, 6)
            own = error[: row + 1, robot]
            assert covariance[PLANAR] == pytest.approx(own.T @ own / (row + 1), abs=1e-12)
            assert np.count_nonzero(covariance) <= 9
        covariances = np.array([message.pose.covariance for _, message in bag[f"/robot_{robot}/odom"]])
        assert not covariances[0].any()  # odometry begins without an error
        assert (covariances[1:, [0, 7, 35]] > 0).all()
        assert all(np.linalg.eigvalsh(row.reshape(6, 6)).min() > -1e-12 for row in covariances)
        twists = np.array([message.twist.covariance for _, message in bag[f"/robot_{robot}/odom"]])
        assert not twists.any()  # the recorded speeds are the true ones


def test_estimates_come_back_from_amcl_pose_alone(house, moving, tmp_path):
    bag = written(house, moving, tmp_path / "bag", topics=("/robot_*/amcl_pose",))
    tracks = Rosbag2().read(bag).tracks
    assert [(track.robot, track.source) for track in tracks] == [("robot_0", "amcl_pose"), ("robot_1", "amcl_pose")]
    assert tracks[0].pose[:, :2] == pytest.approx(moving["estimate"][::10, 0, :2])
