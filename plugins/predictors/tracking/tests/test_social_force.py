"""Prediction by social forces, against the crowd's own model from the same states."""

import numpy as np
import pytest
from mrpbench_native.sim import Walkers
from mrpbench_native.tracking import social_force

NO_WALLS = np.empty((0, 4))
WALL = np.array([(-2.0, 0.7, 2.0, 0.7)])


@pytest.mark.parametrize("walls", [NO_WALLS, WALL], ids=["free", "wall"])
def test_prediction_equals_the_model_of_the_crowd(walls: np.ndarray) -> None:
    wanted = np.array([(1.3, 0.0), (-1.1, 0.0), (0.0, 1.2)])
    place = np.array([(-16.0, 0.1), (16.0, -0.1), (0.3, -15.0)])
    people = {"place": place, "radius": np.full(3, 0.3), "speed": np.hypot(*wanted.T), "group": np.full(3, -1, "i4")}
    walkers = Walkers(segments=walls, people=people, options={}, orca=False)
    nobody = np.empty((0, 4)), np.empty(0)
    wishes = {"velocity": wanted, "push": np.zeros((3, 2)), "regard": np.zeros(3, np.uint8)}
    for _ in range(80):  # until they walk as they want, out of each other's sight
        walkers.step(0.1, wishes, *nobody, 0, NO_WALLS)
    exact = np.hstack([walkers.place, walkers.velocity])
    assert np.allclose(exact[:, 2:], wanted, atol=1e-6)
    wishes["velocity"] = exact[:, 2:].copy()
    predicted = social_force(
        exact, radius=0.3, walls=walls, robots=np.empty((0, 2)), robot_radius=np.empty(0), step=0.1, count=61
    )
    for step in range(1, 61):
        walkers.step(0.1, wishes, *nobody, 0, NO_WALLS)
        assert np.allclose(predicted[:, step], walkers.place, atol=1e-6)
    straight = exact[:, :2] + 6.0 * exact[:, 2:]
    assert np.hypot(*(predicted[:, 60] - straight).T).max() > 0.05  # they did meet


def test_people_are_predicted_to_walk_around_a_robot() -> None:
    person = np.array([(-2.0, 0.05, 1.3, 0.0)])
    options = {"radius": 0.3, "walls": NO_WALLS, "step": 0.1, "count": 31}
    alone = social_force(person, robots=np.empty((0, 2)), robot_radius=np.empty(0), **options)
    beside = social_force(person, robots=np.zeros((1, 2)), robot_radius=np.full(1, 0.2), **options)
    assert np.hypot(*alone[0].T).min() < 0.1
    assert np.hypot(*beside[0].T).min() > 0.45
