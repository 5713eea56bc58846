"""Behaviour without ROS."""

import sys

import pytest
from mrpbench_bridges_ros2.hook import Watcher
from mrpbench_bridges_ros2.link import REQUIRED, Link
from mrpbench_bridges_ros2.navigator import Ros2

from mrpbench_core.api import Navigator
from mrpbench_core.files.errors import InputError


@pytest.fixture
def nothing(monkeypatch):
    """No rclpy, even where it is installed."""
    monkeypatch.setitem(sys.modules, "rclpy", None)


def test_one_line_names_the_missing_package(nothing):
    with pytest.raises(InputError, match="ROS 2 cannot be imported") as raised:
        Link("x")
    assert "source a ROS 2 installation" in str(raised.value)


def test_the_hook_does_nothing_unless_asked(nothing, monkeypatch):
    monkeypatch.delenv("MRPBENCH_ROS2", raising=False)
    watcher = Watcher()
    watcher.mrpbench_executing(None)
    watcher.mrpbench_stepped(0.0, None, ())
    watcher.mrpbench_executed()


def test_a_run_without_ros_begins_with_one_warning(nothing, monkeypatch):
    monkeypatch.setenv("MRPBENCH_ROS2", "1")
    said = Watcher().mrpbench_check()
    assert said.startswith("nothing is published: rclpy")
    assert "source a ROS 2 installation" in said
    assert "\n" not in said


def test_a_wrong_value_is_told_before_the_first_run(nothing, monkeypatch):
    monkeypatch.setenv("MRPBENCH_ROS2", "fast")
    assert Watcher().mrpbench_check() == "MRPBENCH_ROS2=fast: must be 'free' or a number above 0 (times real time)"


def test_missing_messages_are_told_before_the_first_run(monkeypatch):
    monkeypatch.setenv("MRPBENCH_ROS2", "free")
    for name in REQUIRED:
        monkeypatch.setitem(sys.modules, name, object())
    monkeypatch.setitem(sys.modules, "tf2_msgs", None)
    assert Watcher().mrpbench_check() == "neither /tf nor /tf_static is published: tf2_msgs cannot be imported"
    monkeypatch.setitem(sys.modules, "tf2_msgs", object())
    assert Watcher().mrpbench_check() is None


def test_nothing_is_said_unless_asked(nothing, monkeypatch):
    monkeypatch.delenv("MRPBENCH_ROS2", raising=False)
    assert Watcher().mrpbench_check() is None


def test_the_navigator_is_live_and_measures_progress_like_the_cores_own():
    assert Ros2.live
    assert isinstance(Ros2().progress, Navigator)
