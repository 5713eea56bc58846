import runpy
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_policies.fleet_state import FleetState, soft
from mrpbench_policies.maps import FAR, Maps
from mrpbench_policies.observations import PogemaDefault

NUMPY = SimpleNamespace(**runpy.run_path(str(Path(__file__).with_name("numpy_steps.py"))))


def at(drawing, cells):
    """Robots at cells of a map drawn as text."""
    blocked = np.array([[letter == "#" for letter in row] for row in drawing.split()])
    maps = Maps(blocked[None], 2)
    places = maps.places(np.array([cells]))
    return FleetState.at(maps, places, places)


STAY, UP, DOWN, LEFT, RIGHT = range(5)


@pytest.mark.parametrize(
    ("cells", "actions", "after"),
    [
        ([(0, 0), (0, 2)], [RIGHT, LEFT], [(0, 1), (0, 2)]),  # of two the first
        ([(0, 0), (0, 1)], [RIGHT, LEFT], [(0, 0), (0, 1)]),  # a swap
        ([(0, 1), (0, 0)], [RIGHT, RIGHT], [(0, 2), (0, 1)]),  # following
        ([(0, 0), (0, 1), (1, 1), (1, 0)], [RIGHT, DOWN, LEFT, UP], [(0, 1), (1, 1), (1, 0), (0, 0)]),  # a ring
        ([(0, 2), (0, 1), (0, 0)], [RIGHT, RIGHT, RIGHT], [(0, 2), (0, 1), (0, 0)]),  # behind one that hits the wall
        ([(0, 0)], [UP], [(0, 0)]),
    ],
)
def test_soft_resolves_conflicts(cells, actions, after):
    state = at("... ...", cells)
    state.move(soft(state, state.wishes(np.array([actions]))))
    assert state.maps.cells(state.place)[0].tolist() == [list(cell) for cell in after]


@given(st.integers(0, 2**32), st.integers(1, 12))
def test_robots_never_share_a_cell_or_change_places(seed, robots):
    generator = np.random.default_rng(seed)
    blocked = generator.random((3, 4, 5)) < 0.2
    blocked[:, 0] = blocked[:, 1, :3] = False
    maps = Maps(blocked, 1)
    cells = np.stack([generator.permutation(np.argwhere(~one))[:robots] for one in blocked][:3])[:, : min(robots, 8)]
    state = FleetState.at(maps, maps.places(cells), maps.places(cells))
    for _ in range(5):
        before = state.place
        state.move(soft(state, state.wishes(generator.integers(0, 5, before.shape))))
        assert len(np.unique(state.place)) == state.place.size
        assert not maps.blocked[state.place].any()
        swaps = (before[..., None] == state.place[:, None]) & (state.place[..., None] == before[:, None])
        assert not (swaps & ~np.eye(before.shape[1], dtype=bool)).any()


def test_distances_are_those_of_the_shortest_ways():
    state = at("..# .#. ...", [(0, 0)])
    maps = state.maps
    table = maps.distances(int(state.place[0, 0]))
    cells = np.array([[(0, 0), (0, 1), (1, 0), (2, 2), (1, 2), (0, 2)]])
    assert table[maps.places(cells)[0]].tolist() == [0, 1, 1, 4, 5, FAR]
    assert len(maps.component(int(state.place[0, 0]))) == 7
    maps.lay(0, np.zeros((3, 3), bool))
    assert maps.distances(int(state.place[0, 0]))[maps.places(cells)[0]].tolist() == [0, 1, 1, 4, 3, 2]


@given(st.integers(0, 2**32), st.integers(1, 3), st.integers(1, 7))
def test_native_steps_and_windows_are_those_in_numpy(seed, environments, radius):
    """Bit for bit, also with robots that have left the grid and with maps that are laid anew."""
    generator = np.random.default_rng(seed)
    blocked = generator.random((environments, *generator.integers(3, 9, 2))) < generator.uniform(0, 0.4)
    blocked[:, 0] = False
    maps = Maps(blocked, radius)
    robots = int(generator.integers(1, 1 + min((~one).sum() for one in blocked)))
    start, goal = (np.stack([generator.permutation(np.argwhere(~one))[:robots] for one in blocked]) for _ in range(2))
    state = FleetState.at(maps, maps.places(start), maps.places(goal))
    for _ in range(4):
        state.active &= generator.random(state.active.shape) < 0.9
        wish = state.wishes(generator.integers(0, 5, state.place.shape))
        to = soft(state, wish)
        np.testing.assert_array_equal(to, NUMPY.soft(state, wish))
        entered = NUMPY.overwritten(state, to)
        state.move(to)
        np.testing.assert_array_equal(state.overwritten, entered)
        moving = generator.random(state.active.shape) < 0.2
        np.testing.assert_array_equal(state.free_actions(moving), NUMPY.free_actions(state, moving))
        windows = PogemaDefault(radius).observe(state)["observation"]
        np.testing.assert_array_equal(windows, NUMPY.pogema(state, radius))
        cleared = blocked[0] & (generator.random(blocked[0].shape) < 0.9)
        maps.lay(0, cleared)
