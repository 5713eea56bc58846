import numpy as np
import pytest
from mrpbench_native import grid

BLOCKED = np.ones((2, 5, 6), bool)
BLOCKED[:, 1:-1, 1:-1] = False
"""Two rooms of 3 x 4 cells, whose places begin with 7 and 37."""


def maps():
    return grid.Maps(BLOCKED.ravel(), 5, 6)


def arrays(*values, dtype=np.int64):
    return np.array(values, dtype)


def test_robots_of_several_environments_move_at_once():
    to = np.empty((2, 2), np.int64)
    place = arrays([7, 8], [37, 38])
    refused = maps().soft(np.ones((2, 2), bool), place, place + [[1, 1], [1, -1]], to)
    assert to.tolist() == [[8, 9], [37, 38]]
    assert refused == 2


def test_actions_are_free_where_no_wall_is():
    bits = np.empty(2, np.uint8)
    maps().free_actions(arrays(7, 45), bits)
    assert bits.tolist() == [1 + 4 + 16, 1 + 2 + 4 + 8 + 16]


def test_maps_are_read_in_each_call():
    blocked = BLOCKED.ravel().copy()
    here, steps = grid.Maps(blocked, 5, 6), np.empty(30, np.int32)
    blocked[38] = blocked[43] = True
    here.distances(37, steps)
    assert steps[7] == 0
    assert (steps == 1 << 20).sum() == 29


@pytest.mark.parametrize("place", [-1, 60, 2**40])
def test_places_outside_of_the_maps_are_refused(place):
    far, near, flag = arrays(place), arrays(7), np.ones(1, bool)
    here = maps()
    for call in (
        lambda: here.soft(flag, far, near, near.copy()),
        lambda: here.soft(flag, near, far, near.copy()),
        lambda: here.overwritten(flag, near, far, flag.copy()),
        lambda: here.free_actions(far, np.empty(1, np.uint8)),
        lambda: here.distances(place, np.empty(30, np.int32)),
        lambda: here.pogema(flag, near, far, 1, np.empty(27, np.float32)),
    ):
        with pytest.raises(ValueError, match="outside of the maps"):
            call()


def test_windows_beyond_the_maps_and_arrays_that_do_not_fit_are_refused():
    flag, near = np.ones(1, bool), arrays(7)
    with pytest.raises(ValueError, match="outside of the maps"):
        maps().pogema(flag, near, near, 2, np.empty(75, np.float32))
    with pytest.raises(ValueError, match="another size"):
        maps().pogema(flag, near, near, 1, np.empty(26, np.float32))
    with pytest.raises(ValueError, match="one value for each robot"):
        maps().soft(np.ones(2, bool), near, near, near.copy())
    with pytest.raises(ValueError, match="whole maps"):
        grid.Maps(np.zeros(31, bool), 5, 6)
    with pytest.raises(TypeError):
        maps().soft(flag, near.astype(np.int32), near, near.copy())
