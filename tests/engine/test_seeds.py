"""Random streams depend on their key and on nothing else."""

import numpy as np
import pytest

from mrpbench_core.engine.seeds import Seeds


@pytest.mark.parametrize(
    ("seeds", "key"),
    [
        (Seeds(2), ("lidar", 2)),
        (Seeds(1, 1), ("lidar", 2)),
        (Seeds(-1), ("lidar", 2)),
        (Seeds(1), ("odometry", 2)),
        (Seeds(1), ("lidar", 3)),
        (Seeds(1), ("lidar", 2, 1)),
    ],
)
def test_a_stream_repeats_and_differs_by_every_part_of_its_key(seeds, key):
    base = Seeds(1).stream("lidar", 2).random(4)
    np.testing.assert_array_equal(base, Seeds(1).stream("lidar", 2).random(4))
    assert not np.array_equal(base, seeds.stream(*key).random(4))


def test_streams_keep_their_numbers():
    assert Seeds(5, 1).stream("delays.speed", 3, 2).integers(10**6, size=3).tolist() == [50229, 718805, 380185]


def test_component_seeds_repeat():
    assert Seeds(5).seed_of("simulator") == Seeds(5).seed_of("simulator") != Seeds(5, 1).seed_of("simulator")


def test_the_streams_of_many_robots_and_draws_are_those_of_each_alone():
    seeds = Seeds(2**70, 1)
    each = [seeds.stream("delays.speed", robot, draw) for draw in (0, 2) for robot in range(3)]
    found = seeds.streams("delays.speed", 3, (0, 2))
    assert [one.bit_generator.state for one in found] == [one.bit_generator.state for one in each]
