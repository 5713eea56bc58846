"""Estimates, odometry, commands and scans: of bags of our own as they were, of others at the times of the positions."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_analysis.observed_run import Sampling, observe
from mrpbench_exporters_rosbag2 import Rosbag2

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.scenario import Scenario, Task

EXACT = ("truth", "truth_twist", "estimate", "odometry", "command", "scan_time", "scan_robot", "scan_ranges")


def export(context, recording, destination, **options):
    session = Rosbag2(**options).open(context, destination)
    session.write(recording)
    session.close()
    return destination


@settings(max_examples=6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    turned=st.floats(-6.2, 6.2),
    rate=st.floats(-3, 3),
    wrapped=st.booleans(),
    places=st.floats(-1e4, 1e4),
    start=st.floats(0, 2e9),
)
def test_every_channel_of_a_run_comes_back(context, recording, tmp_path_factory, turned, rate, wrapped, places, start):
    yaw = turned + rate * recording["time"]
    if wrapped:
        yaw = np.arctan2(np.sin(yaw), np.cos(yaw))
    recording = {name: np.array(rows) for name, rows in recording.items()}
    for channel in ("truth", "estimate", "odometry"):
        recording[channel][:, 0, 2] = yaw
        recording[channel][..., :2] += places
    bag = export(context, recording, tmp_path_factory.mktemp("turning") / "bag", start_time=start)
    found = Rosbag2().read(bag)
    assert found.notes == ()
    for name in EXACT:
        assert found.channels[name].shape == recording[name].shape, name
        np.testing.assert_allclose(found.channels[name], recording[name], rtol=0, atol=1e-8, err_msg=name)


@pytest.mark.parametrize(
    ("left_out", "lacking"),
    [("odom", {"odometry"}), ("cmd_vel", {"command"}), ("scan", {"scan_time", "scan_robot", "scan_ranges"})],
)
def test_a_channel_whose_topics_were_not_written_is_missing(context, recording, tmp_path, left_out, lacking):
    kept = [f"/robot_*/{name}" for name in ("odom", "cmd_vel", "scan", "ground_truth") if name != left_out]
    bag = export(context, recording, tmp_path / "bag", topics=("/run_data", "/progress", "/tf", *kept))
    assert set(EXACT) - Rosbag2().read(bag).channels.keys() == lacking


def test_a_channel_that_one_robot_lacks_is_missing_and_said(context, recording, tmp_path):
    topics = ("/run_data", "/progress", "/robot_*/ground_truth", "/robot_0/odom")
    found = Rosbag2().read(export(context, recording, tmp_path / "bag", topics=topics))
    assert "odometry" not in found.channels
    assert found.notes == ("not every robot has every sample of odometry: it was not read",)


def observed(bag, context, **options):
    found = Rosbag2(**options).read(bag)
    names = [track.robot for track in found.tracks]
    scenario = Scenario(
        start=[[0.0, index, 0.0] for index in range(len(names))],
        start_level=[0] * len(names),
        tasks=tuple(Task(goals=[[2.0, index, np.nan]]) for index in range(len(names))),
    )
    fleet = Fleet(robots=context.fleet.robots[: len(names)])
    return observe(found, context.world, fleet, scenario, Sampling())


def test_signals_of_a_foreign_bag_are_put_at_the_times_of_its_positions(foreign, context):
    bag = foreign()
    for t in np.arange(0, 4.01, 0.1):
        for index, name in enumerate("ab"):
            bag.odometry(f"/{name}/ground_truth", t, 0.5 * t, index, 0, frame="map", log=t + 1e9)
            bag.amcl(f"/{name}/amcl_pose", t, 0.5 * t + 0.1, index, 0, log=t + 1e9)
    for t in np.arange(0, 4.01, 0.08):
        for name in "ab":
            bag.odometry(f"/{name}/odom", t, 0.5 * t, 7, 3 + t, log=t + 1e9, speed=(0.5, 1.0))
    for name in "ab":
        for t in np.arange(1.05, 2.0, 0.1):
            bag.twist(f"/{name}/cmd_vel", t + 1e9, 0.5, 0.25)  # on the recorder's clock, a billion seconds ahead
        bag.scan(f"/{name}/scan", 1.5, [1.0, np.inf, 2.0], log=1.5 + 1e9)
    found = observed(bag.close(), context)
    time, channels = found.channels["time"], found.channels
    assert channels["estimate"][:, 1, 0] == pytest.approx(0.5 * time + 0.1)
    assert channels["odometry"][:, 0, 2] == pytest.approx(3 + time)
    assert channels["odometry"][:, 0, 3:] == pytest.approx(np.tile([0.5, 1.0], (len(time), 1)))
    told = channels["command"][:, 0]
    assert told[(time > 1.06) & (time < 2.4)] == pytest.approx(np.array([0.5, 0.25]) * np.ones((13, 1)))
    assert not told[(time < 1.04) | (time > 2.5)].any()
    assert channels["scan_time"].tolist() == [1.5, 1.5]
    assert channels["scan_robot"].tolist() == [0, 1]
    assert channels["scan_ranges"].tolist() == [[1.0, np.inf, 2.0]] * 2
    assert found.alike == ()


def test_positions_are_never_compared_with_themselves(foreign, context):
    bag = foreign()
    for t in np.arange(0, 4.01, 0.1):
        bag.amcl("/a/amcl_pose", t, 0.5 * t, 0, 0)
        bag.amcl("/b/amcl_pose", t, 0.5 * t, 1, 0)
        bag.odometry("/a/odom", t, 0.5 * t, 0, 0)
    found = observed(bag.close(), context)
    np.testing.assert_array_equal(found.channels["estimate"], found.channels["truth"])
    assert found.alike == (frozenset({"truth", "estimate"}),)
    assert "odometry" not in found.channels
    assert "b: no odometry, so the channel is not given" in found.notes
