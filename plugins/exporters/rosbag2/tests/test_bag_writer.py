import math
import tracemalloc
from collections import Counter

import attrs
import numpy as np
import pytest
from mcap.reader import make_reader
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.model.common.fleet import Fleet

ROBOTS = ("robot_0", "robot_1")
LATCHED = ("/run", "/run_data", "/map", "/navigation_graph", "/tf_static", "/goals")
CHANNEL_AXES = {"time": "time", "scan": "scan_time", "contact": "contact_time", "event": "event_time"}


def axis_of(channel):
    return CHANNEL_AXES.get(channel.split("_")[0], "time") if channel != "truth_twist" else "time"


def cut(recording, edges):
    """The recording in chunks at times `edges`; what falls on an edge belongs to the earlier chunk."""
    for low, high in zip([-np.inf, *edges], [*edges, np.inf], strict=True):
        inside = {name: (recording[axis_of(name)] > low) & (recording[axis_of(name)] <= high) for name in recording}
        yield {name: recording[name][rows] for name, rows in inside.items()}


def export(context, chunks, destination, **options):
    session = Rosbag2(**options).open(context, destination)
    for chunk in chunks:
        session.write(chunk)
    session.close()
    return destination


@pytest.fixture
def bag(context, recording, tmp_path, read):
    return read(export(context, [recording], tmp_path / "bag"))


def stamps_of(message):
    """Every stamp in a message that has some."""
    parts = [message, *getattr(message, "transforms", ()), *getattr(message, "markers", ())]
    for part in parts:
        if hasattr(part, "header"):
            yield part.header.stamp.sec * 10**9 + part.header.stamp.nanosec
        if hasattr(part, "clock"):
            yield part.clock.sec * 10**9 + part.clock.nanosec


def planar(pose):
    q = pose.orientation if hasattr(pose, "orientation") else pose.rotation
    p = pose.position if hasattr(pose, "position") else pose.translation
    assert math.isclose(math.hypot(q.x, q.y, q.z, q.w), 1, abs_tol=1e-12)
    assert q.x == q.y == 0
    return p.x, p.y, math.atan2(2 * q.w * q.z, 1 - 2 * q.z * q.z)


def test_holds_every_topic_as_often_as_recorded(bag, recording):
    counts = {topic: len(messages) for topic, messages in bag.items()}
    samples, scans = len(recording["time"]), len(recording["scan_time"]) // 2
    instants = len({*recording["time"], *recording["scan_time"], *recording["event_time"], *recording["contact_time"]})
    expected = dict.fromkeys(LATCHED, 1)
    expected |= {"/clock": instants, "/progress": samples, "/tf": samples, "/events": 3, "/contacts": 3}
    expected |= {f"/{name}/amcl_pose": 9 for name in ROBOTS}
    expected |= {"/robots": 41, "/fleet_states": 9}  # 4 s at 10 and 2 Hz, and the start
    for name in ROBOTS:
        expected |= {f"/{name}/{topic}": samples for topic in ("odom", "ground_truth", "cmd_vel")}
        expected |= {f"/{name}/scan": scans, f"/{name}/plan": 1, f"/{name}/goal_pose": 1}
    assert counts == expected


def test_every_stamp_is_the_log_time_and_log_time_never_falls(context, recording, tmp_path, read):
    destination = export(context, [recording], tmp_path / "bag", start_time=1.7e9)
    with (destination / "bag.mcap").open("rb") as file:
        times = [message.log_time for _, _, message in make_reader(file).iter_messages(log_time_order=False)]
    assert times == sorted(times)
    assert times[0] == 1_700_000_000 * 10**9
    assert times[-1] == 1_700_000_004 * 10**9
    for topic, messages in read(destination).items():
        for log_time, message in messages:
            assert all(stamp == log_time for stamp in stamps_of(message)), topic


def test_frames_precede_the_poses_in_them(context, recording, tmp_path):
    destination = export(context, [recording], tmp_path / "bag")
    order = Counter()
    with (destination / "bag.mcap").open("rb") as file:
        for _, channel, message in make_reader(file).iter_messages(log_time_order=False):
            order[channel.topic, message.log_time] = len(order)
    for (topic, stamp), place in order.items():
        if topic.endswith("/scan") and ("/tf", stamp) in order:
            assert order["/tf", stamp] < place
        if topic == "/tf":
            assert order["/clock", stamp] < place


def test_frames_form_a_tree_that_leads_to_the_estimate(bag, recording):
    parents = {}
    for _, message in bag["/tf"] + bag["/tf_static"]:
        for transform in message.transforms:
            assert parents.setdefault(transform.child_frame_id, transform.header.frame_id) == transform.header.frame_id
    assert parents == {
        f"{name}/{child}": parent if parent == "map" else f"{name}/{parent}"
        for name in ROBOTS
        for child, parent in (("odom", "map"), ("base_footprint", "odom"), ("base_scan", "base_footprint"))
    }
    for row, (_, message) in enumerate(bag["/tf"]):
        for index in range(2):
            outer, inner = message.transforms[2 * index : 2 * index + 2]
            assert outer.transform.translation.z == 0.5
            (ox, oy, oyaw), (ix, iy, iyaw) = planar(outer.transform), planar(inner.transform)
            x = ox + math.cos(oyaw) * ix - math.sin(oyaw) * iy
            y = oy + math.sin(oyaw) * ix + math.cos(oyaw) * iy
            expected = recording["estimate"][row, index]
            assert (x, y) == pytest.approx(tuple(expected[:2]), abs=1e-12)
            assert math.remainder(oyaw + iyaw - expected[2], math.tau) == pytest.approx(0, abs=1e-12)


def test_lidar_sits_where_it_is_mounted(bag):
    for index, transform in enumerate(bag["/tf_static"][0][1].transforms):
        assert transform.header.frame_id == f"robot_{index}/base_footprint"
        assert transform.child_frame_id == f"robot_{index}/base_scan"
        offset = transform.transform.translation
        assert (offset.x, offset.y, offset.z) == (-0.032, 0, 0.182)


@pytest.mark.parametrize("index", [0, 1])
def test_odometry_truth_and_commands_are_the_recorded(bag, recording, index):
    cases = [
        ("odom", f"robot_{index}/odom", recording["odometry"][:, index, :3], recording["odometry"][:, index, 3:]),
        ("ground_truth", "map", recording["truth"][:, index], recording["truth_twist"][:, index]),
    ]
    for topic, frame, poses, twists in cases:
        messages = bag[f"/robot_{index}/{topic}"]
        for (stamp, message), time, pose, twist in zip(messages, recording["time"], poses, twists, strict=True):
            assert stamp == round(time * 1e9)
            assert message.header.frame_id == frame
            assert message.child_frame_id == f"robot_{index}/base_footprint"
            x, y, yaw = planar(message.pose.pose)
            assert (x, y) == tuple(pose[:2])
            assert math.remainder(yaw - pose[2], math.tau) == pytest.approx(0, abs=1e-12)
            assert message.pose.pose.position.z == (0.5 if topic == "ground_truth" else 0.0)
            assert (message.twist.twist.linear.x, message.twist.twist.angular.z) == tuple(twist)
            assert message.twist.twist.linear.y == message.twist.twist.angular.x == 0
            assert topic == "odom" or not np.any(message.pose.covariance)
    for (_, message), command in zip(bag[f"/robot_{index}/cmd_vel"], recording["command"][:, index], strict=True):
        assert (message.linear.x, message.angular.z) == tuple(command)


@pytest.mark.parametrize("index", [0, 1])
def test_scans_have_the_geometry_of_the_lidar(bag, recording, index):
    rows = recording["scan_robot"] == index
    messages = bag[f"/robot_{index}/scan"]
    for (stamp, scan), time, ranges in zip(
        messages, recording["scan_time"][rows], recording["scan_ranges"][rows], strict=True
    ):
        assert stamp == round(time * 1e9)
        assert scan.header.frame_id == f"robot_{index}/base_scan"
        assert np.array_equal(np.array(scan.ranges, "f4"), ranges)
        assert scan.ranges[3] == math.inf
        assert scan.angle_min == 0
        assert scan.angle_increment == pytest.approx(math.tau / 8, abs=1e-7)
        assert scan.angle_max == pytest.approx(math.tau * 7 / 8, abs=1e-6)
        assert (scan.range_min, scan.range_max) == (pytest.approx(0.12), 3.5)
        assert (scan.scan_time, scan.time_increment) == (pytest.approx(0.2), 0)


def test_lidars_may_differ_and_chunks_be_as_wide_as_their_widest_scan(context, recording, tmp_path, read):
    first, second = context.fleet.robots
    narrow = attrs.evolve(second, lidar=attrs.evolve(second.lidar, beams=4))
    mixed = attrs.evolve(context, fleet=Fleet(robots=(first, narrow)))
    time = np.array([0.0, 0.1, 0.2])
    ranges = np.arange(24, dtype="f4").reshape(3, 8)
    periodic = {name: recording[name] for name in ("time", "truth")}
    chunks = [
        {"scan_time": time[:1], "scan_robot": np.array([1]), "scan_ranges": ranges[:1, :4]},
        {"scan_time": time[1:2], "scan_robot": np.array([0]), "scan_ranges": ranges[1:2]},
        {"scan_time": time[2:], "scan_robot": np.array([1]), "scan_ranges": ranges[2:, :4]},
        periodic,
    ]
    bag = read(export(mixed, chunks, tmp_path / "bag"))
    assert [list(scan.ranges) for _, scan in bag["/robot_0/scan"]] == [list(ranges[1])]
    assert [list(scan.ranges) for _, scan in bag["/robot_1/scan"]] == [list(ranges[0, :4]), list(ranges[2, :4])]


def test_robots_are_drawn_where_they_truly_are_at_most_ten_times_a_second(bag, recording):
    stamps = [stamp for stamp, _ in bag["/robots"]]
    assert min(np.diff(stamps)) == 10**8
    truth = dict(zip((round(time * 1e9) for time in recording["time"]), recording["truth"], strict=True))
    for stamp, message in bag["/robots"]:
        seen = {(marker.ns, marker.id): marker for marker in message.markers}
        assert set(seen) == {(kind, index) for kind in ("robots", "footprints", "names") for index in (0, 1)}
        for (kind, index), marker in seen.items():
            assert marker.header.frame_id == "map"
            x, y, yaw = planar(marker.pose)
            assert (x, y) == tuple(truth[stamp][index, :2])
            assert math.remainder(yaw - truth[stamp][index, 2], math.tau) == pytest.approx(0, abs=1e-12)
            assert marker.type == {"robots": 3, "footprints": 4, "names": 9}[kind]  # cylinder, line strip, text
        body = seen["robots", 1]
        assert body.scale.x == body.scale.y == pytest.approx(2 * math.hypot(0.1, 0.08))
        assert body.pose.position.z == pytest.approx(0.5 + 0.15 / 2)
        assert seen["names", 1].text == "robot_1"
        outline = [(point.x, point.y) for point in seen["footprints", 0].points]
        assert outline == [(-0.1, -0.08), (0.1, -0.08), (0.1, 0.08), (-0.1, 0.08), (-0.1, -0.08)]


def test_events_and_contacts_are_diagnostics(bag):
    def facts(topic):
        for stamp, message in bag[topic]:
            (status,) = message.status
            yield stamp, status.name, status.message, {pair.key: pair.value for pair in status.values}

    assert list(facts("/events")) == [
        (0, "fleet", "replan", {"detail": ""}),
        (1_050_000_000, "robot_0", "recovery", {"detail": "spin"}),
        (3_999_000_000, "robot_1", "abort", {"detail": "no way to place_7"}),
    ]
    assert list(facts("/contacts")) == [
        (1_000_000_000, "robot_0", "contact", {"other": "robot_1"}),
        (1_050_000_000, "robot_0", "contact", {"other": "robot_1"}),
        (2_025_000_000, "robot_1", "contact", {"other": "wall"}),
    ]


@pytest.mark.parametrize("edges", [[1.0], [0.0, 0.05, 0.07, 2.0, 2.0, 3.999, 9.0], list(np.arange(0, 4, 0.013))])
def test_chunk_borders_leave_no_trace(context, recording, tmp_path, edges):
    def contents(bag):
        with (bag / f"{bag.name}.mcap").open("rb") as file:
            messages = make_reader(file).iter_messages(log_time_order=False)
            return [(channel.topic, message.log_time, message.data) for _, channel, message in messages]

    whole = contents(export(context, [recording], tmp_path / "whole"))
    assert contents(export(context, cut(recording, edges), tmp_path / "cut")) == whole


def test_a_scan_that_comes_before_the_pose_of_its_instant_is_written_after_it(context, recording, tmp_path, read):
    early = {name: values for name, values in recording.items() if axis_of(name) != "time"}
    periodic = {name: values for name, values in recording.items() if axis_of(name) == "time"}
    whole = read(export(context, [recording], tmp_path / "whole"))
    split = read(export(context, [early, periodic], tmp_path / "split"))
    assert {topic: len(messages) for topic, messages in split.items()} == {t: len(m) for t, m in whole.items()}
    assert [stamp for stamp, _ in split["/robot_0/scan"]] == [stamp for stamp, _ in whole["/robot_0/scan"]]


def test_memory_does_not_grow_with_the_run(context, recording, tmp_path):
    session = Rosbag2().open(context, tmp_path / "bag")
    held = []
    tracemalloc.start()
    for turn in range(40):
        later = {name: values + 4.05 * turn if name.endswith("time") else values for name, values in recording.items()}
        session.write(later)
        held.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    session.close()
    assert (tmp_path / "bag" / "bag.mcap").stat().st_size > 2**20
    assert max(held[20:]) < max(held[:20]) + 2**18


def test_writes_only_the_requested_topics(context, recording, tmp_path, read):
    topics = ("/tf*", "/robot_1/odom", "/events")
    bag = read(export(context, [recording], tmp_path / "bag", topics=topics))
    assert set(bag) == {"/tf", "/tf_static", "/robot_1/odom", "/events"}


def test_a_run_that_ended_after_planning_has_its_plan(context, tmp_path, read):
    bag = read(export(context, [], tmp_path / "bag"))
    assert set(bag) == set(LATCHED) | {f"/{n}/{t}" for n in ROBOTS for t in ("plan", "goal_pose")}


def test_channels_that_were_not_recorded_leave_their_topics_out(context, recording, tmp_path, read):
    chunk = {name: recording[name] for name in ("time", "truth", "truth_twist", "command")}
    bag = read(export(context, [chunk], tmp_path / "bag"))
    assert {"/tf", "/robot_0/odom", "/robot_0/scan", "/events", "/contacts"}.isdisjoint(bag)
    assert len(bag["/robot_1/ground_truth"]) == len(recording["time"])


def test_closing_twice_is_harmless(context, tmp_path):
    session = Rosbag2().open(context, tmp_path / "bag")
    session.close()
    session.close()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bag"]


def test_a_failure_leaves_nothing_behind(context, recording, tmp_path):
    session = Rosbag2().open(context, tmp_path / "bag")
    with pytest.raises(ValueError, match="shape"):
        session.write(recording | {"odometry": recording["odometry"][:, :1]})
    session.close()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("start", [-1.0, 3e9, math.nan])
def test_a_start_that_ros_cannot_stamp_is_refused(start):
    with pytest.raises(ValueError, match="start_time"):
        Rosbag2(start_time=start)


def test_an_abandoned_bag_leaves_nothing_behind(context, tmp_path):
    session = Rosbag2().open(context, tmp_path / "bag")
    session.abandon()
    session.close()
    assert list(tmp_path.iterdir()) == []
