import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_worlds_standard.barn import PATH_LENGTH
from mrpbench_worlds_standard.generated.field import GeneratedField, dilated, shortest_way, smoothed

from mrpbench_core.files.errors import InputError


def centres(world):
    return np.array(sorted(obstacle.polygon.mean(axis=0).round(6).tolist() for obstacle in world.levels[0].obstacles))


def test_a_seed_draws_one_field_on_the_lattice_of_the_challenge():
    first, same, other = (GeneratedField(seed=seed).load() for seed in (1, 1, 2))
    assert (centres(first) == centres(same)).all()
    assert centres(first).shape != centres(other).shape or (centres(first) != centres(other)).any()
    lattice = (centres(first) - (-4.425, 0.075)) / 0.15
    assert lattice == pytest.approx(lattice.round(), abs=1e-4)
    inside = (lattice.round()[:, 0] % 29 != 0) & (lattice.round()[:, 1] > 0)
    assert (lattice[inside, 1] > 33.5).all()  # the pocket in the south is empty


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**40), fill=st.sampled_from([0.15, 0.2, 0.25]), smoothings=st.integers(2, 4))
def test_a_disc_of_the_robot_fits_and_the_reference_path_is_at_least_straight(seed, fill, smoothings):
    world = GeneratedField(seed=seed, fill=fill, smoothings=smoothings).load()
    assert 10.0 <= world.vertices[1].parameters[PATH_LENGTH] <= 20.0
    field = centres(world)
    distance = np.hypot(*(field - (-2.25, 3.0)).T)
    assert distance.min() > 0.4


def test_the_automaton_fills_crowded_cells_and_empties_lonely_ones():
    cells = np.zeros((5, 5), bool)
    cells[2, 2] = True
    assert not smoothed(cells, 1).any()
    ring = np.ones((5, 5), bool)
    ring[2, 2] = False
    assert smoothed(ring, 1)[2, 2]
    assert (smoothed(cells, 0) == cells).all()


def test_the_shortest_way_goes_around_what_is_occupied():
    free = np.ones((5, 30), bool)
    straight = shortest_way(free)
    assert len(straight) == 5
    assert set(straight[:, 0]) <= {14.0, 15.0}
    free[2, :25] = False
    detour = shortest_way(free)
    assert detour[detour[:, 1] == 2][0, 0] == 25
    free[2] = False
    assert shortest_way(free) is None


def test_robots_keep_two_cells_away():
    filled = np.zeros((9, 9), bool)
    filled[4, 4] = True
    assert (np.argwhere(dilated(filled)) == np.argwhere(np.pad(np.ones((5, 5), bool), 2))).all()


def test_a_field_that_cannot_be_crossed_is_an_error():
    with pytest.raises(InputError, match="can be crossed"):
        GeneratedField(fill=0.35, smoothings=10, seed=3).load()
