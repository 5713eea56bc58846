"""Random streams depend on their key and on nothing else."""

import numpy as np

from mrpbench_core.engine.seeds import seed_of, stream


def test_a_stream_repeats_and_differs_by_every_part_of_its_key():
    base = stream(1, 0, "lidar", 2).random(4)
    np.testing.assert_array_equal(base, stream(1, 0, "lidar", 2).random(4))
    for other in [
        (2, 0, "lidar", 2),
        (1, 1, "lidar", 2),
        (1, 0, "odometry", 2),
        (1, 0, "lidar", 3),
        (-1, 0, "lidar", 2),
    ]:
        assert not np.array_equal(base, stream(*other).random(4))


def test_component_seeds_repeat():
    assert seed_of(5, 0, "simulator") == seed_of(5, 0, "simulator") != seed_of(5, 1, "simulator")
