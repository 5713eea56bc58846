"""Random streams depend on their key and on nothing else."""

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from mrpbench_core.engine.seeds import seed_of, stream, streams


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


@given(
    st.one_of(st.integers(-5, 5), st.integers()),
    st.integers(0, 9),
    st.text(max_size=9),
    st.integers(0, 4),
    st.lists(st.integers(0, 2**32 - 1), unique=True, max_size=4).map(sorted),
)
@example(2**32, 1, "delays.speed", 3, [0, 1, 2])
def test_the_streams_of_many_robots_and_draws_are_those_of_each_alone(seed, repeat, name, robots, draws):
    found = streams(seed, repeat, name, robots, draws)
    each = [stream(seed, repeat, name, robot, draw) for draw in draws for robot in range(robots)]
    assert [one.bit_generator.state for one in found] == [one.bit_generator.state for one in each]
