"""Configurations drawn from the JSON Schema; `make soak` runs many more."""

import runpy
from collections import Counter
from pathlib import Path

import pytest

pytest.importorskip("mrpbench_planners_mapf")
SOAK = runpy.run_path(str(Path(__file__).with_name("soak_configurations.py")))
COUNT = 3


def test_a_drawn_configuration_is_refused_in_a_line_or_ends_in_a_definite_status():
    ends = Counter()
    faults = [SOAK["fault_of"](SOAK["Drawing"](seed, 0.05).configuration(), ends) for seed in range(COUNT)]
    assert not any(faults)
    assert 0 < ends["refused"] < ends.total()
