import runpy
from pathlib import Path

import pytest

SOAK = runpy.run_path(str(Path(__file__).with_name("soak_pogema.py")))


def test_steps_are_those_of_pogema():
    """Places, observations of three kinds, rewards, ends and metrics, element by element."""
    if not SOAK["PYTHON"].exists():
        pytest.skip("POGEMA is not installed: `make pogema` does it")
    assert SOAK["compare"](600, seed=1) >= 600
