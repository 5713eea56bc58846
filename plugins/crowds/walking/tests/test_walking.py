import numpy as np
import pytest
from mrpbench_crowds_walking import Carts, Orca, SocialForce
from mrpbench_crowds_walking.crowds import Person
from mrpbench_crowds_walking.reactions import nearest_seen, react
from mrpbench_worlds_standard.generated.warehouse import GeneratedWarehouse
from mrpbench_worlds_standard.shipped import Encounters

from mrpbench_core.api import CrowdView, Movers
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.testing import CrowdConformance
from mrpbench_core.testing.fixtures.building import building
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room

NOBODY = Movers(pose=np.empty((0, 3)), velocity=np.empty((0, 2)), level=np.empty(0, "i2"))
ACROSS = (
    Person(start=(0.6, 1.5), goals=((3.4, 1.5), (0.6, 1.5)), speed=1.2),
    Person(start=(3.4, 1.5), goals=((0.6, 1.5), (3.4, 1.5)), speed=1.2),
)


class TestSocialForce(CrowdConformance):
    def make(self):
        return SocialForce(people=6, group_size=2)


class TestOrca(CrowdConformance):
    def make(self):
        return Orca(people=6, given=ACROSS[:1])


class TestCarts(CrowdConformance):
    def make(self):
        return Carts(people=2)


def view(*robots, facilities=()):
    pose = np.array(robots, float).reshape(-1, 3)
    state = State(
        pose=pose, twist=np.zeros((len(pose), 2)), level=[0] * len(pose), contacts=[], facilities=dict(facilities)
    )
    return CrowdView(state=state, others=NOBODY, radius=np.empty(0))


def walk(crowd, seconds, *robots, world=None, seed=0):
    seen = view(*robots)
    session = crowd.start(world or room(), fleet(len(robots)), seed, seen)
    return session, np.array([session.step(PERIOD, seen).pose for _ in range(round(seconds / PERIOD))])


def test_places_of_people_may_be_names_of_the_world():
    world = Encounters(case="crossing").load()
    named, stated = (
        Orca(given=(Person(start=start, goals=goals),)).start(world, fleet(0), 1, view())
        for start, goals in (("person", ("person_goal",)), ((4.0, 20.8), ((4.0, 0.8),)))
    )
    for _ in range(10):
        np.testing.assert_array_equal(named.step(0.1, view()).pose, stated.step(0.1, view()).pose)
    with pytest.raises(InputError, match="level 0 of world encounters_crossing has no place 'persn'"):
        Orca(given=(Person(start="persn"),)).start(world, fleet(0), 1, view())


@pytest.mark.parametrize("kind", [SocialForce, Orca])
def test_two_people_who_meet_head_on_pass_and_arrive(kind):
    session, found = walk(kind(given=ACROSS, stay=60.0), 12)
    assert found[:, 0, 0].max() > 2.7
    assert found[:, 1, 0].min() < 1.3
    assert session.movers.arrivals.tolist() == [1, 1]
    assert np.hypot(*(found[:, 0, :2] - found[:, 1, :2]).T).min() >= 0.5 - 2e-4


@pytest.mark.parametrize("kind", [SocialForce, Orca])
def test_a_person_walks_round_a_robot_that_stands(kind):
    _, found = walk(kind(given=ACROSS[:1], stay=60.0), 12, (2.0, 1.5, 0.0))
    assert found[:, 0, 0].max() > 2.7
    gap = np.hypot(*(found[:, 0, :2] - (2.0, 1.5)).T).min() - 0.25 - fleet(1).radii[0]
    assert gap >= 0.05 - 2e-4


@pytest.mark.parametrize("kind", [SocialForce, Orca])
def test_people_whom_a_robot_or_a_person_blocks_in_an_aisle_take_another(kind):
    world = GeneratedWarehouse(shelf_columns=1, shelf_rows=3).load()
    left, right = (1.0, 3.2), (7.0, 3.2)  # at the ends of an aisle of 0.8 m, in which two do not pass
    given = tuple(Person(start=start, goals=(end, start), speed=1.2) for start, end in ((left, right), (right, left)))
    session, _ = walk(kind(given=given, stay=60.0), 40, (4.0, 3.2, 0.0), world=world)
    assert session.movers.arrivals.tolist() == [1, 1]


def test_people_go_through_doors_that_they_open():
    crowd = Orca(given=(Person(start=(1.2, 1.5), goals=((2.3, 0.6),)),), radius=0.2)
    session = crowd.start(building(), fleet(0), 0, view(facilities=Facilities(building()).initial_state()))
    state = Facilities(building()).initial_state()
    shut, opened = view(facilities=state), view(facilities=state | {"door": 1.0})
    asked = False
    for _ in range(100):
        session.step(PERIOD, shut)
        asked |= "door" in session.wanted_doors()
    assert asked
    assert session.movers.pose[0, 0] < 2.0  # the leaf is solid
    for _ in range(100):
        session.step(PERIOD, opened)
    assert session.movers.pose[0, 0] > 2.15


def test_nobody_begins_inside_a_robot_or_a_member_of_another_crowd():
    robots = [(x, y, 0.0) for x in (0.5, 1.5, 2.5, 3.5) for y in (0.6, 1.5, 2.4)]
    seen = view(*robots)
    cart = Movers(pose=[(2.0, 1.0, 0.0)], velocity=np.zeros((1, 2)), level=np.zeros(1, "i2"))
    seen = CrowdView(state=seen.state, others=cart, radius=np.array([0.3]))
    for seed in range(5):
        place = Orca(people=2).start(room(), fleet(len(robots)), seed, seen).movers.pose[:, :2]
        reach = np.append(fleet(len(robots)).radii, 0.3) + 0.25
        bodies = np.array([*robots, *cart.pose])[:, :2]
        assert (np.hypot(*(place[:, None] - bodies).transpose(2, 0, 1)) >= reach).all()


def test_a_given_place_inside_a_robot_is_refused():
    with pytest.raises(InputError, match=r"person 0 of `given` begins at .*, inside a robot"):
        Orca(given=ACROSS).start(room(), fleet(1), 0, view((0.7, 1.5, 0.0)))


def test_what_one_does_at_random_depends_on_its_index_alone():
    few, many = (SocialForce(people=n, group_size=1).start(room(), fleet(0), 3, view()) for n in (2, 5))
    assert np.array_equal(few._speed, many._speed[:2])
    assert np.array_equal(few._goal, many._goal[:2])


def test_surprised_people_stand_and_look():
    crowd = SocialForce(given=ACROSS[:1], reaction="surprised")
    _, found = walk(crowd, 3, (2.5, 1.5, 0.0))
    assert found[-1, 0, 0] < 0.8
    assert abs(found[-1, 0, 2]) < 0.05


def reacting(reaction, gap, yaw=0.0):
    """What two people do: one 3 m before a robot, one in the robot's place and about to stand."""
    robot, goal = np.array([[3.0, 0.0, yaw]] * 2), np.array([[0.0, 1.3], [0.0, 0.0]])
    return react(reaction, np.array([[0.0, 0.0], [3.0, 0.0]]), robot, np.array([gap, -0.3]), goal)


def test_reactions_have_the_speeds_of_hunavsim():
    assert reacting("curious", 2.5).velocity == pytest.approx(np.array([[0.54, 0], [0, 0]]))
    assert reacting("scared", 2.0).velocity == pytest.approx(np.array([[0, 0.6], [0, 0]]))
    assert reacting("scared", 2.0).push == pytest.approx(np.array([[-2.0, 0], [-20, 0]]))
    assert reacting("threatening", 2.5, np.pi).velocity == pytest.approx(np.array([[2.0, 0], [-2.0, 0]]))


def test_robots_behind_or_far_away_are_not_seen():
    robots, yaw = np.array([[-1.0, 0.0], [0.0, 2.0], [9.0, 0.0]]), np.array([0.0, np.pi, 0.5 - np.pi / 2])
    assert nearest_seen(np.zeros((3, 2)), yaw, robots, 4.0).tolist() == [1, 0, -1]
    assert nearest_seen(np.zeros((3, 2)), yaw, robots[2:], 4.0).tolist() == [-1, -1, -1]
    assert nearest_seen(np.zeros((3, 2)), yaw, robots[:0], 4.0).tolist() == [-1, -1, -1]


@pytest.mark.parametrize(
    ("crowd", "said"),
    [(Orca(people=500), "room for"), (Orca(level=3), "no level 3"), (Carts(radius=3.0), "nobody of radius"),
     (Orca(given=(Person(start=(0.0, 1.0)),)), r"cannot walk from \(0.0, 1.0\) to \(0.0, 1.0\)")],
)  # fmt: skip
def test_what_does_not_fit_is_said_in_one_line(crowd, said):
    with pytest.raises(InputError, match=said):
        crowd.start(room(), fleet(0), 0, view())
