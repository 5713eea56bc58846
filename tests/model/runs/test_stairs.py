"""Staircases lose their corners, as in the original benchmark."""

import numpy as np
import pytest

from mrpbench_core.model.runs.stairs import without_stairs


@pytest.mark.parametrize(
    ("cells", "kept"),
    [
        pytest.param([(0, 0), (1, 0), (1, 1), (2, 1), (2, 2)], [1, 0, 1, 0, 1], id="a staircase"),
        pytest.param([(0, 0), (1, 0), (2, 0), (3, 0)], [1, 1, 1, 1], id="a straight line"),
        pytest.param([(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)], [1, 1, 0, 1, 1], id="one corner"),
        pytest.param([(0, 0), (0, 0), (0, 0), (1, 0)], [1, 0, 1, 1], id="one of equal waits"),
        pytest.param([(0, 0), (1, 0), (0, 0), (1, 0)], [1, 0, 1, 1], id="there and back"),
        pytest.param([(0, 0), (1, 0)], [1, 1], id="too short for a corner"),
        pytest.param([(0, 0)], [1], id="a robot that stays"),
    ],
)
def test_corners_between_equal_distances_are_left_out(cells, kept):
    waypoint = 0.35 * np.array(cells, float) + 7.0
    assert without_stairs(waypoint).tolist() == [bool(one) for one in kept]
