"""The metric `contact` on touches counted by hand."""

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Contact

STILL = [[(0, 0)] * 3] * 4


@pytest.fixture
def touching(executed):
    """Control period 0.05 s. Robots 0 and 1 touch in 3 periods, twice; robots 0 and 2 each touch a wall once."""
    contacts = [(3.0, 0, 1), (3.05, 0, 1), (6.0, 0, 1), (4.0, 0, -1), (2.5, 2, -1), (2.55, 2, -1)]
    return executed([2, 5, 8], STILL, [[0] * 3] * 4, [[(0, 0)]] * 4, contacts=contacts)


def test_touches_are_counted_timed_and_dated(touching):
    values = Contact().measure(touching)
    assert values["robots_touched"] == 3
    assert values["robot_time_s"] == pytest.approx(0.15)
    assert values["wall_time_s"] == pytest.approx(0.15)
    assert values["first_s"] == 0.5


def test_the_largest_force_is_that_of_contacts_whose_force_is_known(touching):
    assert Contact().measure(touching)["force_max_n"] is None
    forces = np.array([1.0, 7.5, np.nan, 2.0, 3.0, 4.0])
    known = attrs.evolve(touching, channels={**touching.channels, "contact_force": lambda: forces})
    assert Contact().measure(known)["force_max_n"] == 7.5


def test_the_pause_between_contacts_is_an_option_of_execution():
    assert Contact(pause=1.0) == Contact()
    with pytest.raises(ValueError, match="`contact_pause`"):
        Contact(pause=3.0)


def test_the_order_of_robots_does_not_matter(touching, permuted):
    assert Contact().measure(permuted(touching, [2, 3, 1, 0])) == Contact().measure(touching)


def test_runs_without_contacts_have_no_first_contact(executed):
    values = Contact().measure(executed([2, 5, 8], STILL, [[0] * 3] * 4, [[(0, 0)]] * 4))
    assert values.pop("first_s") is None
    assert values.pop("force_max_n") is None
    assert set(values.values()) == {0}


def test_unreported_touches_are_null_not_zero(touching):
    channels = {name: load for name, load in touching.channels.items() if name != "contact"}
    assert set(Contact().measure(attrs.evolve(touching, channels=channels)).values()) == {None}
