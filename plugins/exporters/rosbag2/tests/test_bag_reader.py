"""Bags of other fleets, read back."""

import re

import numpy as np
import pytest
from mrpbench_exporters_rosbag2 import Rosbag2
from rosbags.typesys import Stores

from mrpbench_core.files.errors import InputError


def drive(index, t):
    """Location robot `index` is at t seconds: along x, 1 m apart."""
    return 1.0 + 0.2 * t, 1.0 + index, 0.1 * t


def read(bag, *robots, **options):
    return Rosbag2(**options).read(bag.close(), robots)


def sources(observed):
    return {track.robot: track.source for track in observed.tracks}


TIMES = np.arange(0, 5.05, 0.1)
STORAGES = [("mcap", Stores.ROS2_JAZZY, 9), ("sqlite3", Stores.ROS2_HUMBLE, 8), ("sqlite3", Stores.ROS2_JAZZY, 9)]


@pytest.mark.parametrize(("storage", "distribution", "version"), STORAGES)
def test_fleet_states_are_read_by_the_bags_own_definitions(foreign, storage, distribution, version):
    bag = foreign(storage, distribution, version)
    for t in TIMES:
        bag.fleet(1.7e9 + t, {"b": drive(1, t), "a": drive(0, t)})
        bag.fleet(1.7e9 + t, {"c": drive(2, t)}, name="other")
    observed = read(bag, fleet="tinyRobot")
    assert [track.robot for track in observed.tracks] == ["a", "b"]
    for index, track in enumerate(observed.tracks):
        assert (track.source, track.topic, set(track.levels)) == ("fleet_states", "/fleet_states", {"L1"})
        assert track.time == pytest.approx(TIMES, abs=1e-9)
        assert track.pose == pytest.approx(np.array([drive(index, t) for t in TIMES]), abs=1e-6)
        assert np.isnan(track.height).all()
    assert observed.notes == ()


def test_the_best_source_of_each_robot_is_taken(foreign):
    bag = foreign()
    for t in TIMES:
        states = {}
        for index, name in enumerate(("r_truth", "r_tf", "r_amcl", "r_odom", "r_10", "r_9")):
            place = drive(index, t)
            states[name] = place
            if index < 4:
                bag.odometry(f"/{name}/odom", t, t, 0, 0)
            if index < 3:
                bag.amcl(f"/{name}/amcl_pose", t, *place)
            if index < 2:
                bag.transform("/tf", t, f"{name}/odom", f"{name}/base_footprint", t, 0, 0)
                bag.transform("/tf", t, "map", f"{name}/odom", 1, 1, 0)
            if index < 1:
                bag.odometry(f"/{name}/ground_truth", t, *place, frame="map")
        bag.fleet(t, states)
    found = sources(read(bag))
    assert found == {
        "r_truth": "ground_truth",
        "r_tf": "tf",
        "r_amcl": "amcl_pose",
        "r_odom": "odometry",
        "r_9": "fleet_states",
        "r_10": "fleet_states",
    }
    assert [name for name in found if name[2:].isdigit()] == ["r_9", "r_10"]


@pytest.mark.parametrize("namespaced", [False, True])
def test_transforms_are_chained_from_the_map_to_the_base(foreign, namespaced):
    bag = foreign()
    topic, prefix = ("/tb1/tf", "") if namespaced else ("/tf", "tb1/")
    bag.transform(f"{topic}_static", 0, f"{prefix}base_link", f"{prefix}base_scan", 0.1, 0, 0)
    bag.transform(f"{topic}_static", 0, f"{prefix}base_footprint", f"{prefix}base_link", 0, 0, 0)
    for t in (0.0, 2.0):  # localization corrects now and then
        bag.transform(topic, t, "map", f"{prefix}odom", 2.0 + t, 3.0, np.pi / 2)
    for t in (0.0, 0.5, 1.0, 2.0, 3.0):
        bag.transform(topic, t, f"{prefix}odom", f"{prefix}base_footprint", t, 1.0, 0.25)
    (track,) = read(bag).tracks
    assert (track.robot, track.source, track.placed) == ("tb1", "tf", True)
    assert track.time.tolist() == [0, 0.5, 1, 2, 3]
    corrections = np.array([2.0, 2.5, 3.0, 4.0, 4.0])  # straight between, held after the last
    expected = np.stack([corrections - 1.0, 3.0 + track.time, np.full(5, np.pi / 2 + 0.25)], axis=1)
    assert track.pose == pytest.approx(expected)


def test_a_ring_of_frames_is_no_way_to_the_map(foreign):
    bag = foreign()
    for t in TIMES:
        bag.transform("/tf", t, "a/base_footprint", "a/odom", 0, 0, 0)
        bag.transform("/tf", t, "a/odom", "a/base_footprint", 0, 0, 0)
        bag.amcl("/a/amcl_pose", t, *drive(0, t))
    assert sources(read(bag)) == {"a": "amcl_pose"}


def test_odometry_says_whether_it_is_in_the_map(foreign):
    bag = foreign()
    for t in TIMES:
        bag.odometry("/a/odom", t, *drive(0, t))
        bag.odometry("/b/odom", t, *drive(1, t), frame="/map")
    assert [track.placed for track in read(bag).tracks] == [False, True]


def test_a_robot_without_a_namespace_is_found(foreign):
    bag = foreign()
    for t in TIMES:
        bag.odometry("/odom", t, *drive(0, t))
        bag.amcl("/amcl_pose", t, *drive(0, t))
    assert sources(read(bag)) == {"robot": "amcl_pose"}


def test_topics_are_found_by_other_patterns(foreign):
    bag = foreign()
    for t in TIMES:
        bag.odometry("/fleet/x/odometry/filtered", t, *drive(0, t))
    (track,) = read(bag, odometry=("/fleet/{robot}/odometry/filtered",)).tracks
    assert (track.robot, track.topic) == ("x", "/fleet/x/odometry/filtered")


def test_robots_are_chosen_by_pattern(foreign):
    bag = foreign()
    for t in TIMES:
        for name in ("a1", "a2", "b1"):
            bag.amcl(f"/{name}/amcl_pose", t, *drive(0, t))
    assert list(sources(read(bag, "a*"))) == ["a1", "a2"]


def test_the_error_for_a_bag_without_poses_lists_its_topics(foreign):
    bag = foreign()
    bag.amcl("/initialpose", 0, 0, 0, 0)
    with pytest.raises(
        InputError, match=r"holds no pose of any robot: its topics are /initialpose \(geometry_msgs/Pose"
    ):
        read(bag)


@pytest.mark.parametrize(("by", "way"), [(-20.0, "back by 1[0-9]"), (1.7e9, "ahead by 17000000")])
def test_where_the_clock_jumps_the_longer_part_is_used(foreign, by, way):
    bag = foreign()
    for t in TIMES:
        stamp = 100.0 + t if t < 1.0 else 100.0 + t + by
        for name in "ab":
            bag.odometry(f"/{name}/ground_truth", stamp, *drive(0, t), frame="map", log=1000.0 + t)
    observed = read(bag)
    (note,) = observed.notes
    assert re.search(f"clock jumps {way}.*82 of 102", note)
    for track in observed.tracks:
        assert track.time == pytest.approx(TIMES[TIMES >= 0.999] - 1.0, abs=1e-6)


def test_log_times_replace_stamps_that_are_not_set(foreign):
    bag = foreign()
    for t in TIMES:
        bag.odometry("/a/ground_truth", 0, *drive(0, t), frame="map", log=50 + t)
        bag.odometry("/b/ground_truth", 7 + t, *drive(1, t), frame="map", log=50 + t)
    observed = read(bag)
    assert "log times" in observed.notes[0]
    for track in observed.tracks:
        assert track.time == pytest.approx(TIMES, abs=1e-6)


def test_messages_out_of_order_are_sorted_and_unsound_ones_left_out(foreign):
    bag = foreign()
    for t, log in ((0.0, 0.0), (0.2, 0.1), (0.1, 0.2), (0.2, 0.3), (0.4, 0.4)):
        x = float("nan") if t == 0.4 else log
        bag.odometry("/a/ground_truth", 10 + t, x, 0, 0, frame="map", log=log)
    observed = read(bag)
    (track,) = observed.tracks
    assert track.time == pytest.approx([0, 0.1, 0.2])
    assert track.pose[:, 0].tolist() == [0.0, 0.2, 0.3]  # of two at one time, the later said
    assert observed.notes == ("/a/ground_truth: 1 poses are not finite",)


def filled(foreign, storage, step=0.02):
    bag = foreign(storage)
    for t in np.arange(0, 60, step):
        bag.amcl("/a/amcl_pose", 100 + t, *drive(0, t))
    bag.close()
    (file,) = (path for path in bag.path.iterdir() if path.suffix in (".mcap", ".db3"))
    return bag.path, file


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_bag_without_metadata_is_read(foreign, storage):
    path, file = filled(foreign, storage)
    whole = Rosbag2().read(path).tracks[0]
    assert np.array_equal(Rosbag2().read(file).tracks[0].pose, whole.pose)
    (path / "metadata.yaml").unlink()
    observed = Rosbag2().read(path)
    assert np.array_equal(observed.tracks[0].pose, whole.pose)
    assert "read without metadata.yaml" in observed.notes[0]
    (path / "metadata.yaml").write_text("rosbag2_bagfile_information: {version: [")
    assert np.array_equal(Rosbag2().read(path).tracks[0].pose, whole.pose)


@pytest.mark.parametrize("part", [0.3, 0.8])
def test_the_complete_part_of_a_truncated_mcap_is_read(foreign, part):
    path, file = filled(foreign, "mcap", step=0.005)
    whole = Rosbag2().read(path).tracks[0]
    content = file.read_bytes()
    file.write_bytes(content[: int(len(content) * part)])
    observed = Rosbag2().read(path)
    rows = len(observed.tracks[0].time)
    assert (part - 0.25) * len(whole.time) < rows <= part * len(whole.time)
    assert np.array_equal(observed.tracks[0].pose, whole.pose[:rows])
    assert any("damaged" in note for note in observed.notes)


def test_the_readable_part_of_a_damaged_database_is_read(foreign):
    path, file = filled(foreign, "sqlite3")
    whole = Rosbag2().read(path).tracks[0]
    content = bytearray(file.read_bytes())
    middle = len(content) // 2 // 4096 * 4096
    content[middle : middle + 40960] = b"\xff" * 40960
    file.write_bytes(content)
    observed = Rosbag2().read(path)
    rows = len(observed.tracks[0].time)
    assert 0.3 * len(whole.time) < rows < 0.7 * len(whole.time)
    assert np.array_equal(observed.tracks[0].pose, whole.pose[:rows])
    assert any("damaged" in note for note in observed.notes)


@pytest.mark.parametrize("content", [b"", b"no bag", b"\x89MCAP0\r\n", b"SQLite format 3\x00" + b"\x00" * 200])
@pytest.mark.parametrize("suffix", [".mcap", ".db3"])
def test_files_that_are_no_bags_are_refused_in_one_line(tmp_path, content, suffix):
    file = tmp_path / f"x{suffix}"
    file.write_bytes(content)
    with pytest.raises(InputError) as caught:
        Rosbag2().read(file)
    assert "\n" not in str(caught.value)


def test_a_folder_without_a_bag_is_refused(tmp_path):
    for path in (tmp_path, tmp_path / "missing"):
        with pytest.raises(InputError, match="bag"):
            Rosbag2().read(path)
