import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.maps import Maps
from mrpbench_policies.shields import SHIELDS, pibt

STAY, UP, DOWN, LEFT, RIGHT = range(5)


def corridor(cells, shape=(1, 4)):
    maps = Maps(np.zeros((1, *shape), bool), 1)
    places = maps.places(np.array([cells]))
    return FleetState.at(maps, places, places)


def scores(*actions):
    one_hot = np.zeros((len(actions), 5))
    one_hot[np.arange(len(actions)), actions] = 1.0
    return one_hot


@given(st.integers(0, 2**32), st.sampled_from(sorted(SHIELDS)))
def test_no_shield_lets_robots_collide(seed, name):
    generator = np.random.default_rng(seed)
    blocked = generator.random((1, 5, 5)) < 0.25
    blocked[0, 0] = False
    maps = Maps(blocked, 1)
    free = np.argwhere(~blocked[0])
    places = maps.places(generator.permutation(free)[None, : generator.integers(1, len(free) + 1)])
    state = FleetState.at(maps, places, places)
    wanted = generator.random((places.shape[1], 5))
    to = SHIELDS[name](state, wanted.argmax(axis=1), wanted, generator.integers(0, 5, places.shape[1]))
    assert np.isin(to - places, maps.offset).all()
    assert not maps.blocked[to].any()
    assert len(np.unique(to)) == to.size
    swaps = (places[0][:, None] == to[0]) & (to[0][:, None] == places[0])
    assert not (swaps & ~np.eye(to.size, dtype=bool)).any()


def test_pibt_lets_the_robot_with_priority_push_others_away():
    state = corridor([(0, 0), (0, 1)])
    to = pibt(state, np.array([RIGHT, STAY]), scores(RIGHT, STAY), np.array([1, 0]))
    assert state.maps.cells(to)[0].tolist() == [[0, 1], [0, 2]]


def test_pibt_goes_back_where_nobody_can_make_room():
    state = corridor([(0, 2), (0, 3)])
    to = pibt(state, np.array([RIGHT, STAY]), scores(RIGHT, STAY), np.array([1, 0]))
    assert state.maps.cells(to)[0].tolist() in ([[0, 2], [0, 3]], [[0, 1], [0, 3]])


@pytest.mark.parametrize("name", sorted(SHIELDS))
def test_actions_without_conflicts_stay_as_they_are(name):
    state = corridor([(0, 0), (0, 1), (0, 3)])
    actions = np.array([RIGHT, RIGHT, STAY])
    to = SHIELDS[name](state, actions, scores(*actions), np.zeros(3, int))
    assert (to == state.wishes(actions[None])).all()
