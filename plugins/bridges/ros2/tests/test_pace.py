import pytest
from mrpbench_bridges_ros2 import pace
from mrpbench_bridges_ros2.hook import factor
from mrpbench_bridges_ros2.pace import Pace

from mrpbench_core.files.errors import InputError


@pytest.fixture
def clock(monkeypatch):
    """A wall clock that is set by hand."""
    now = [100.0]
    monkeypatch.setattr(pace.time, "monotonic", lambda: now[0])
    return now


def test_waits_for_the_wall_clock(clock):
    twice = Pace(2.0)
    assert twice.left(5.0) == 0  # where it begins
    assert twice.left(7.0) == 1.0
    clock[0] += 0.25
    assert twice.left(7.0) == 0.75


def test_a_late_period_does_not_shorten_later_ones(clock):
    real = Pace(1.0)
    real.left(0.0)
    clock[0] += 3
    assert real.left(1.0) == 0
    assert real.left(4.0) == 1.0


def test_freely_never_waits(clock):
    assert Pace(None).left(1e9) == 0


@pytest.mark.parametrize(("text", "wanted"), [("free", None), ("1", 1.0), ("0.5", 0.5)])
def test_the_variable_names_the_pace(text, wanted):
    assert factor(text) == wanted


@pytest.mark.parametrize("text", ["0", "-1", "nan", "inf", "fast"])
def test_other_words_are_refused(text):
    with pytest.raises(InputError, match=f"MRPBENCH_ROS2={text}"):
        factor(text)
