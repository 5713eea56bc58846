"""Contacts of one robot with one person, divided by who moved, in encounters made by hand."""

import numpy as np
import pytest
from mrpbench_metrics_standard.who_moved import contacts_of

FOOTPRINT = np.array([(0.3, 0.1), (-0.3, 0.1), (-0.3, -0.1), (0.3, -0.1)])
RADIUS, DT = 0.2, 0.1


def count(robot, person, pause=1.0):
    """Contacts by the robot and by the person, at poses f8[T,3] and places f8[T,2]."""
    robot, person = np.asarray(robot, float), np.asarray(person, float)
    gap = np.hypot(*(person - robot[:, :2]).T) - RADIUS - np.hypot(0.3, 0.1)
    time = DT * np.arange(len(robot))
    return contacts_of(FOOTPRINT, time, robot, person[:, None], np.array([RADIUS]), gap[:, None], pause)


def moving(start, end, steps=20):
    return np.linspace(start, end, steps)


def still(place, steps=20):
    return np.tile(np.array(place, float), (steps, 1))


@pytest.mark.parametrize(
    ("robot", "person", "expected"),
    [
        (moving((0, 0, 0), (0.5, 0, 0)), still((1.0, 0)), (1, 0)),
        (still((0, 0, 0)), moving((1.0, 0), (0.5, 0)), (0, 1)),
        (moving((0, 0, 0), (0.3, 0, 0)), moving((1.0, 0), (0.6, 0)), (1, 0)),
        (moving((0, 0, 0), (-0.2, 0, 0)), moving((1.0, 0), (0.2, 0)), (0, 1)),  # it flees, and is overtaken
        (moving((0, 0, np.pi / 2), (0, 0, 0)), still((0.45, 0)), (1, 0)),  # it turns a corner into the person
        (moving((0, 0, 0), (2.0, 0, 0)), still((1.0, 0.35)), (0, 0)),  # only its circumscribed disc passes through
        (still((0, 0, 0)), still((0.45, 0)), (0, 0)),  # they touch from the beginning, and nobody moved
    ],
)
def test_a_contact_is_of_who_moves_towards_the_other(robot, person, expected):
    assert count(robot, person) == expected


def test_touches_soon_after_one_another_are_one_contact():
    there_and_back = np.concatenate([moving((1.0, 0), (0.5, 0), 11), moving((0.6, 0), (1.0, 0), 11)])
    twice = np.concatenate([there_and_back, there_and_back])
    robot = still((0, 0, 0), len(twice))
    assert count(robot, twice, pause=10.0) == (0, 1)
    assert count(robot, twice, pause=0.5) == (0, 2)
