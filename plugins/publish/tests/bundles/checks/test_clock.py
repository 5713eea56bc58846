"""Clocks that run faster than machines do are found, and honest differences of machines are not."""

import numpy as np
import pytest
from mrpbench_publish.bundles.checks.clock import clock_faults
from mrpbench_publish.bundles.opened import Stored

from mrpbench_core.engine.processes.machine import machine

OTHER = {"processor": "another one"}


def pairs(count=20, *, cpu=1.0, wall=1.0, made_on=None, planner="cbs", seed=0):
    """Runs whose claimed times are those here, with noise, times `cpu` and `wall`."""
    draw = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        here = draw.lognormal(-2, 1)
        claimed = here * draw.lognormal(0, 0.1)
        record = {
            "config": {"planner": {"plugin": planner}},
            "timing": {"planning_s": claimed * wall, "planning_cpu_s": claimed * cpu},
            "provenance": {"machine": made_on or machine()},
        }
        again = {"timing": {"planning_s": here * 1.02, "planning_cpu_s": here}}
        found.append((Stored(shard="one", record=record, counts=True), again))
    return found


@pytest.mark.parametrize("speed", [0.7, 1.0, 1.5])
def test_honest_times_pass(speed):
    assert list(clock_faults(pairs(cpu=speed, wall=speed))) == []


@pytest.mark.parametrize("speed", [0.3, 1.0, 3.0])
def test_another_machine_may_be_faster_or_slower(speed):
    assert list(clock_faults(pairs(cpu=speed, wall=speed, made_on=OTHER))) == []


def test_a_faster_clock_on_the_same_processor_is_found():
    (fault,) = clock_faults(pairs(cpu=0.3, wall=0.3))
    assert "times the CPU time on the same processor (median of 20 runs)" in fault


def test_a_clock_that_no_machine_has_is_found():
    (fault,) = clock_faults(pairs(cpu=0.1, wall=0.1, made_on=OTHER))
    assert "times the CPU time on this processor" in fault


def test_one_planner_with_a_faster_clock_is_named():
    both = pairs(made_on=OTHER) + pairs(cpu=0.33, wall=0.33, made_on=OTHER, planner="mine", seed=1)
    (fault,) = clock_faults(both)
    assert fault.startswith("mine is 3.")


def test_wall_time_alone_that_was_shortened_is_found():
    (fault,) = clock_faults(pairs(wall=0.4))
    assert fault == "planning has 2.5 times as much CPU time as wall time, here 1.0 times"


def test_few_or_short_times_say_nothing():
    assert list(clock_faults(pairs(4, cpu=0.01))) == []
    short = pairs(cpu=0.01)
    for stored, again in short:
        stored.record["timing"]["planning_cpu_s"] = again["timing"]["planning_cpu_s"] = 1e-5
    assert list(clock_faults(short)) == []
