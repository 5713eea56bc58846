"""Batteries of vehicles, compared with those of the task source `charging`."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_live.vda5050.battery import Battery

speeds = st.tuples(st.floats(0, 2), st.floats(0, 3))


@given(speeds, speeds, st.floats(0, 60))
def test_vehicles_use_what_robots_of_the_task_source_use(before, twist, seconds):
    energy = pytest.importorskip("mrpbench_energy")
    theirs = energy.Battery()
    joules = theirs.motion(np.array([before]), np.array([twist]), seconds)[0] + theirs.ambient * seconds
    metres = (before[0] + twist[0]) / 2 * seconds
    assert Battery().after(0.5, seconds, metres, before, twist) == pytest.approx(0.5 - joules / theirs.energy)


def test_a_vehicle_that_charges_uses_nothing():
    battery = Battery(capacity=10.0, charging_current=5.0)
    assert battery.after(0.25, 3600.0, 0.0, (0.0, 0.0), (0.0, 0.0), charging=True) == pytest.approx(0.75)
    assert battery.after(0.75, 3600.0, 0.0, (0.0, 0.0), (0.0, 0.0), charging=True) == 1.0
    assert battery.after(0.0, 3600.0, 100.0, (0.0, 0.0), (0.0, 0.0)) == 0.0
