"""Small policies and models for the tests of this distribution."""

import runpy
import types
from pathlib import Path

import pytest

GREEDY = '''\
"""Goes where the way to the goal is shortest."""

import numpy as np


class Policy:
    def __init__(self, robots, seed):
        pass

    def act(self, observations):
        window = observations["observation"][:, 2]
        middle = window.shape[-1] // 2
        around = ((0, 0), (-1, 0), (1, 0), (0, -1), (0, 1))
        return np.stack([window[:, middle + row, middle + column] for row, column in around], axis=1)
'''


@pytest.fixture(scope="session")
def greedy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a Python file with a policy for `cost_to_go`."""
    file = tmp_path_factory.mktemp("policy") / "greedy.py"
    file.write_text(GREEDY)
    return file


@pytest.fixture(scope="session")
def models() -> types.SimpleNamespace:
    """Return the functions of `models.py`, which make ONNX models."""
    return types.SimpleNamespace(**runpy.run_path(str(Path(__file__).with_name("models.py"))))
