"""The metric `stops` on stands timed by hand."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Stops

WAY = [(0, 0), (2, 0), (5, 0)]


@pytest.fixture
def halting(executed):
    """Each second. Robot 0 stands 1 s, drives 2 s, stands 3 s, drives 1 s, stands 1 s, drives 2 s and has arrived.
    Robot 1 never leaves and never arrives."""
    xs = [0, 0, 1, 2, 2, 2, 2, 3, 3, 4, 5, 5, 5]
    reached = [0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2]
    run = executed(range(13), [[(x, 0) for x in xs], [(0, 9)] * 13], [reached, [0] * 13], [WAY, WAY])
    released = np.array([[1] * 5 + [2] * 8, [0] * 13]).T
    return attrs.evolve(run, channels={**run.channels, "released": lambda: released})


def test_stops_are_counted_between_departure_and_arrival(halting):
    assert Stops().measure(halting)["count"] == 2
    assert Stops(least=1.5).measure(halting)["count"] == 1


def test_standing_is_timed_before_arrival_only(halting):
    values = Stops().measure(halting)
    assert (values["standing_s"], values["standing_max_s"]) == (5 + 12, 12)


def test_only_standing_with_leave_to_go_on_counts_as_released(halting):
    """Released at the start (1 s) and from 5 s on: 5 to 6 s, and 7 to 8 s; robot 1 never is."""
    assert Stops().measure(halting)["standing_released_s"] == 3


def test_without_the_channel_released_only_that_is_null(halting):
    channels = {name: load for name, load in halting.channels.items() if name != "released"}
    values = Stops().measure(attrs.evolve(halting, channels=channels))
    assert values == Stops().measure(halting) | {"standing_released_s": None}


def test_a_robot_that_turns_on_the_spot_does_not_stand(executed):
    run = executed(range(5), [[(0, 0)] * 5], [[0] * 5], [WAY])
    yaw = np.array([3.0, 3.1, 3.2 - 2 * np.pi, -3.0, -3.0])
    truth = np.stack([np.zeros(5), np.zeros(5), yaw], axis=1)[:, None]
    turning = attrs.evolve(run, channels={**run.channels, "truth": lambda: truth})
    values = Stops().measure(turning)
    assert (values["standing_s"], values["count"]) == (1, 1)
