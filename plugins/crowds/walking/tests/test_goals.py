"""What people do: activities and their order, independent of what holds them up."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_crowds_walking import SocialForce
from mrpbench_crowds_walking.goals import ActivityGoals, shared_out

from mrpbench_core.api import CrowdView, Movers
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.worlds.routines import Activity, PeopleGroup
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room

THERE = Activity(name="there", places=[(3.0, 1.5)], level=[0], reach=0.5, following=((1, 1.0),))
REST = Activity(name="rest", time=(2.0, 2.0), following=((2, 1.0),))
BACK = attrs.evolve(THERE, name="back", places=[(1.0, 1.5)])
HOME = attrs.evolve(
    room(), activities=(THERE, REST, BACK), people=(PeopleGroup(people=2, x=1, y=1, level=0, activity=0),)
)
ONE, FAR, AT = np.array([-1]), np.array([9.0]), np.array([0.0])


NOBODY = CrowdView(
    state=State(pose=np.empty((0, 3)), twist=np.empty((0, 2)), level=[], contacts=[], facilities={}),
    others=Movers(pose=np.empty((0, 3)), velocity=np.empty((0, 2)), level=[]),
    radius=[],
)


def begun_in(world, seed=0, **options):
    return SocialForce(**options).start(world, fleet(0), seed, NOBODY)


def walk(session, seconds=15):
    return np.array([session.step(PERIOD, NOBODY).pose for _ in range(round(seconds / PERIOD))])


def draws(person, number):
    return np.random.default_rng([person, number])


def goals(*activities, group=ONE):
    return ActivityGoals(group, draws, 0.65, activities, [0] * len(group), np.zeros((len(group), 2)))


def test_people_walk_to_a_place_rest_and_walk_back():
    begun = goals(THERE, REST, BACK)
    assert (begun.place.tolist(), begun.advance(0.5, FAR).tolist()) == ([[3, 1.5]], [False])
    assert begun.advance(0.5, AT).tolist() == [True]  # rests
    assert [bool(begun.advance(0.5, AT)[0]) for _ in range(4)] == [True, True, True, False]
    assert (begun.place.tolist(), begun.arrivals.tolist()) == ([[1, 1.5]], [1])


@pytest.mark.parametrize(
    ("either", "reached", "late", "goes_on"),
    [(True, True, False, True), (True, False, True, True), (False, True, False, False), (False, True, True, True)],
)
def test_place_and_time_end_an_activity_together_or_either(either, reached, late, goes_on):
    both = attrs.evolve(THERE, time=(4.0, 4.0), either=either)
    begun = goals(both, Activity(name="end"))
    begun.advance(5.0 if late else 1.0, AT if reached else FAR)
    assert (begun._activity[0] == 1) == goes_on


@given(st.lists(st.floats(0.1, 9.0), min_size=1, max_size=8))
def test_what_is_drawn_does_not_depend_on_when_people_arrive(delays):
    choice = attrs.evolve(THERE, places=[(x, 1.0) for x in range(9)], level=[0] * 9, following=((0, 1.0),))
    early, late = goals(choice), goals(choice)
    for delay in delays:
        early.advance(0.1, AT)
        late.advance(delay, FAR)
        late.advance(delay, AT)
        assert np.array_equal(early.place, late.place)


def test_a_group_does_the_same_together():
    choice = attrs.evolve(THERE, places=[(x, 1.0) for x in range(99)], level=[0] * 99, following=((0, 1.0),))
    begun = goals(choice, group=np.array([4, 4, 7]))
    for _ in range(5):
        begun.advance(0.1, np.array([9.0, 0.0, 9.0]))
        assert begun.place[0].tolist() == begun.place[1].tolist()
    assert begun.arrivals.tolist() == [0, 5, 0]


def test_a_following_activity_is_drawn_by_its_weight():
    first = attrs.evolve(REST, time=(0.0, 0.0), following=((1, 1.0), (2, 3.0), (3, 0.0)))
    ends = [Activity(name=str(number)) for number in range(3)]
    begun = ActivityGoals(np.full(4000, -1), draws, 0.65, (first, *ends), [0] * 4000, np.zeros((4000, 2)))
    begun.advance(0.1, np.full(4000, 9.0))
    assert np.bincount(begun._activity, minlength=4)[1:] / 4000 == pytest.approx([0.25, 0.75, 0.0], abs=0.03)


@given(st.lists(st.integers(1, 9), min_size=1, max_size=5), st.integers(0, 60))
def test_every_group_has_its_share_whatever_the_number_of_people(sizes, count):
    groups = [PeopleGroup(people=size, x=0, y=0, level=0, activity=index) for index, size in enumerate(sizes)]
    chosen = shared_out(groups, count)
    assert chosen == shared_out(groups, count + 3)[:count]
    for group in groups:
        assert abs(chosen.count(group) - count * group.people / sum(sizes)) < len(sizes)


def test_by_default_there_are_as_many_as_the_world_says():
    session = begun_in(HOME)
    assert np.hypot(*(session.movers.pose[:, :2] - (1, 1)).T).max() < 0.8, "they begin where the world says"
    walk(session)
    assert len(session.members) == 2
    assert (session.movers.arrivals >= 2).all()
    assert len(begun_in(room()).members) == 0
    assert len(begun_in(HOME, people=5).members) == 5


def test_without_activities_people_walk_between_random_places():
    bare, home = (begun_in(world, people=3, activities=False) for world in (room(), HOME))
    assert np.array_equal(walk(bare, 5), walk(home, 5))


def test_places_that_nobody_comes_to_are_left_out_or_refused():
    shut = attrs.evolve(THERE, places=[(30.0, 30.0)])
    with pytest.raises(InputError, match="nobody comes to a place of 'there' on level 0"):
        begun_in(attrs.evolve(HOME, activities=(shut, REST, BACK)))
    session = begun_in(attrs.evolve(HOME, activities=(THERE, REST, shut)))
    walk(session)
    assert (session.movers.arrivals == 1).all(), "they rest where nothing follows"
