import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_analysis.calibration import Drive, calibrate

from mrpbench_core.files.errors import InputError

TURN, STOP, TICK = 1.4, 0.5, 0.1
ways = st.lists(st.tuples(st.floats(5, 100), st.integers(0, 9)), max_size=20)


def drive(driving, turns, executed):
    planned = driving + TURN * turns + STOP
    return Drive(driving, TURN * turns, turns, STOP, TICK, planned, executed)


@given(ways, st.floats(0.5, 1), st.floats(-1.2, 2), st.floats(-0.3, 2))
def test_a_controller_that_is_linear_in_way_and_turns_is_found_again(drawn, share, turn, stop):
    drives = [drive(5, 0, np.nan), drive(0, 1, 1)]  # one does not arrive, one does not move
    for driving, turns in [(10, 0), (10, 1), (50, 2), *drawn]:
        drives.append(drive(driving, turns, driving / share + (TURN + turn) * turns + STOP + stop))
    found = calibrate(drives)
    assert found.options == pytest.approx({"speed_share": share, "turn_penalty": turn, "stop_penalty": stop}, abs=0.006)
    assert found.after == pytest.approx(0, abs=1e-9)


@given(st.lists(st.tuples(st.floats(5, 100), st.integers(0, 9), st.floats(0.5, 2)), max_size=20))
def test_no_option_makes_a_turn_or_a_stop_shorter_than_a_tick_or_a_robot_faster_than_it_is(drawn):
    drives = [drive(s, turns, s * f + turns) for s, turns, f in [(10, 0, 1.0), (10, 1, 0.8), (50, 2, 0.9), *drawn]]
    found = calibrate(drives).options
    assert found["speed_share"] <= 1
    assert found["turn_penalty"] >= round(TICK - TURN, 2)
    assert found["stop_penalty"] >= round(TICK - STOP, 2)


@pytest.mark.parametrize("drives", [[], [drive(10, 2, 14)] * 9, [drive(s, 1, s + 2) for s in range(5, 20)]])
def test_drives_that_do_not_differ_say_too_little(drives):
    with pytest.raises(InputError, match="say too little"):
        calibrate(drives)
