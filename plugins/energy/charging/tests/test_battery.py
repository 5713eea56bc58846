"""The model of Open-RMF, against its formulas integrated in small steps, and against figures of its demonstrations."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_energy import Battery, Energy
from mrpbench_energy.ledger import STEP, Ledger
from mrpbench_energy.site import Chargers

HOUR = 3600.0
SOMEWHERE = Chargers(names=("dock",), position=np.array([[0.0, 0.0]]), level=np.array([0], np.int16))
LEVEL = np.zeros(1, np.int16)


def driven(battery, speed, turn_rate, seconds, at=(9.0, 9.0), step=STEP):
    """The ledger of one robot whose speeds are functions of time."""
    ledger = Ledger(Energy(battery=battery), SOMEWHERE, 1)
    pose = np.array([[*at, 0.0]])
    for now in np.arange(0.0, seconds + 1e-9, step):
        ledger.update(now, pose, np.array([[speed(now), turn_rate(now)]]), LEVEL)
    return ledger


def test_a_robot_that_stands_and_one_that_drives_discharge_as_in_the_demonstrations():
    standing = driven(Battery(), lambda _: 0.0, lambda _: 0.0, HOUR)
    assert 1 - standing.charge[0] == pytest.approx(0.069, abs=5e-4)
    driving = driven(Battery(), lambda _: 0.5, lambda _: 0.0, HOUR)
    assert standing.charge[0] - driving.charge[0] == pytest.approx(0.075, abs=5e-4)


def test_charging_follows_the_formula_within_a_percent_all_the_way():
    battery = Battery(initial=0.1)
    ledger, pose, still = Ledger(Energy(battery=battery), SOMEWHERE, 1), np.zeros((1, 3)), np.zeros((1, 2))
    full_s = HOUR * 0.9 * battery.capacity / battery.charging_current  # 3600 ΔSoC C / A
    assert full_s == pytest.approx(4.3 * HOUR, rel=0.01)
    curve = []
    for now in np.arange(0.0, 5 * HOUR, 10 * STEP):
        ledger.update(now, pose, still, LEVEL)
        curve.append((now, ledger.charge[0]))
    for now, charge in curve:
        assert charge == pytest.approx(min(1.0, 0.1 + now * 5.0 / (3600.0 * 24.0)), rel=0.01)
    first_full = next(now for now, charge in curve if charge >= 1.0)
    assert first_full == pytest.approx(full_s, rel=0.01)
    assert ledger.gained[0] == pytest.approx(0.9 * 12.0 * 24.0 * HOUR)


@given(
    capacity=st.floats(1, 100),
    voltage=st.floats(6, 60),
    mass=st.floats(1, 500),
    inertia=st.floats(0, 50),
    friction=st.floats(0, 0.5),
    ambient=st.floats(0, 200),
    top=st.floats(0.1, 2.0),
    turn=st.floats(0.0, 2.0),
)
def test_a_drive_costs_what_the_formula_integrates_to(capacity, voltage, mass, inertia, friction, ambient, top, turn):
    battery = Battery(
        capacity=capacity, voltage=voltage, mass=mass, inertia=inertia, friction=friction, ambient=ambient
    )

    def speed(now):  # ten seconds up, twenty even, ten down
        return top * min(1.0, now / 10, (40 - now) / 10)

    def turn_rate(now):
        return turn * min(1.0, now / 20, (40 - now) / 20)

    time = np.linspace(0.0, 40.0, 2_001)
    v, w = np.array([speed(now) for now in time]), np.array([turn_rate(now) for now in time])
    power = mass * abs(np.gradient(v, time)) * v + inertia * abs(np.gradient(w, time)) * w
    power += friction * mass * 9.81 * v + ambient
    joules = float(np.sum((power[1:] + power[:-1]) / 2 * np.diff(time)))
    ledger = driven(battery, speed, turn_rate, 40.0)
    assert ledger.used[0] == pytest.approx(joules, rel=0.01)
    assert ledger.charge[0] == pytest.approx(max(0.0, 1 - joules / (3600 * capacity * voltage)), abs=0.01)


def test_samples_between_two_steps_change_nothing():
    def speed(now):
        return 0.3 + 0.1 * np.sin(now)

    often = driven(Battery(), speed, lambda _: 0.0, 60.0, step=0.05)
    assert often.charge[0] == pytest.approx(driven(Battery(), speed, lambda _: 0.0, 60.0).charge[0], rel=1e-12)


@pytest.mark.parametrize("option", [{"capacity": 0}, {"voltage": -1}, {"initial": 1.5}, {"friction": -0.1}])
def test_impossible_batteries_are_refused(option):
    with pytest.raises(ValueError, match=next(iter(option))):
        Battery(**option)
