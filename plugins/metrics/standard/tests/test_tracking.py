"""The metric `tracking` on errors measured by hand."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_metrics_standard import Tracking


def released(run, rows):
    orders = np.array(rows, "i4").T
    return attrs.evolve(run, channels={**run.channels, "released": lambda: orders})


def test_errors_are_distances_from_the_path_at_hand(executed):
    """A corner at (2, 0) after a wait there; the error is 0.5 m, 0 m, 0.2 m (corner cut: beside both legs), 0.1 m."""
    points = [(0, 0), (2, 0), (2, 0), (2, 4)]
    track = [(0.5, 0.5), (1, 0), (1.8, 0.2), (1.9, 3), (2, 4)]
    run = released(executed(range(5), [track], [[0, 0, 0, 2, 3]], [points]), [[3] * 5])
    values = Tracking().measure(run)
    assert values["max_m"] == pytest.approx(0.5)
    assert values["mean_m"] == pytest.approx((0.5 + 0 + 0.2 + 0.1) / 4)
    assert values["p95_m"] == pytest.approx(0.2 + 0.85 * 0.3)


def test_going_on_without_leave_is_an_error(executed):
    run = executed([0, 1], [[(0, 0), (3, 0)]], [[0, 1]], [[(0, 0), (2, 0), (4, 0)]])
    assert Tracking().measure(released(run, [[2, 2]]))["max_m"] == 0
    assert Tracking().measure(released(run, [[1, 1]]))["max_m"] == pytest.approx(1.0)


def test_a_part_of_the_path_far_ahead_hides_no_error(executed):
    """The path comes back 1 m above; a robot that is up there during the first leg is 1 m off."""
    there_and_back = [(0, 0), (4, 0), (8, 0), (8, 1), (4, 1), (0, 1)]
    run = executed([0, 1], [[(1, 1), (1, 1)]], [[0, 0]], [there_and_back])
    assert Tracking().measure(released(run, [[5, 5]]))["mean_m"] == 1


def test_robots_that_have_arrived_are_not_measured(executed):
    run = executed([0, 1], [[(5, 5), (5, 5)]], [[1, 1]], [[(0, 0), (1, 0)]])
    assert set(Tracking().measure(released(run, [[1, 1]])).values()) == {None}


@settings(deadline=None, max_examples=50)
@given(data=st.data(), angle=st.floats(0, 7), shift=st.floats(-50, 50))
def test_errors_do_not_depend_on_where_the_axes_lie(executed, data, angle, shift):
    place = st.tuples(st.integers(-5, 5), st.integers(-5, 5))
    points = data.draw(st.lists(place, min_size=2, max_size=6))
    track = data.draw(st.lists(place, min_size=4, max_size=4))
    reached = sorted(data.draw(st.lists(st.integers(0, len(points) - 2), min_size=4, max_size=4)))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    one, other = (
        Tracking().measure(
            released(executed(range(4), [place(track)], [reached], [place(points)]), [[len(points) - 1] * 4])
        )
        for place in (np.array, lambda points: np.array(points) @ turn + shift)
    )
    assert one == pytest.approx(other, abs=1e-9)
