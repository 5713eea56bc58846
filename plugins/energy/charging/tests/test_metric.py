"""The metric on recordings written by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_energy.metric import SHORTEST, _charges


@given(st.lists(st.tuples(st.integers(-1, 2), st.integers(1, 60)), min_size=1, max_size=20))
def test_a_charge_is_a_stay_at_one_charger_of_ten_seconds_or_more(stays):
    at = np.repeat([charger for charger, _ in stays], [steps for _, steps in stays])
    wanted, length, last = 0, 0.0, None
    for charger in [*at.tolist(), None]:
        if charger != last:
            wanted += last is not None and last >= 0 and length >= SHORTEST
            length, last = 0.0, charger
        length += 0.5
    assert _charges(at, np.full(len(at), 0.5)) == wanted


@pytest.mark.parametrize("charger", [-1, 0])
def test_a_run_without_changes_is_one_stay_or_none(charger):
    assert _charges(np.full(30, charger), np.full(30, 0.5)) == charger + 1
