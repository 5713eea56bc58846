import pytest
from mrpbench_live.fleet import pace
from mrpbench_live.fleet.pace import Pace


@pytest.fixture
def clock(monkeypatch):
    """A wall clock that is set by hand."""
    now = [100.0]
    monkeypatch.setattr(pace.time, "monotonic", lambda: now[0])
    return now


@pytest.mark.usefixtures("clock")
def test_simulated_time_is_due_by_the_factor():
    twice = Pace(2.0)
    assert twice.due(5.0) == 100.0  # where it begins
    assert twice.due(7.0) == 101.0


def test_a_run_that_falls_behind_says_so_once_and_when_it_has_caught_up(clock):
    real = Pace(1.0)
    real.due(0.0)
    clock[0] = 100.1
    assert real.change(0.0) is None
    clock[0] = 101.5
    assert real.change(1.0) == "0.50 s behind the clock at pace 1"
    assert real.change(1.0) is None
    clock[0] = 102.0
    assert real.change(2.0) == "caught up with the clock after 0.50 s behind it"
    assert real.change(3.0) is None
