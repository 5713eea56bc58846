"""Who charges where, step by step."""

import numpy as np
import pytest
from mrpbench_energy import Battery, Charging, Energy
from mrpbench_energy.charging import ChargingStream
from mrpbench_energy.ledger import STEP, Ledger
from mrpbench_energy.site import Chargers

from mrpbench_core.api import InputError, State, TaskStream
from mrpbench_core.builtin.task_sources.poisson import Poisson
from mrpbench_core.model.worlds.world import Level, Vertex, World
from mrpbench_core.testing.fixtures.office import office, office_roadmap
from mrpbench_core.testing.fixtures.room import fleet

QUICK = Battery(capacity=0.1, voltage=10, ambient=36, charging_current=3.6)
"""1 % a second, either way."""


class Nothing(TaskStream):
    """No tasks."""

    def released(self, now, finished):
        return ()


class Floor:
    """Robots that are at once where they are sent."""

    def __init__(self, robots, chargers, **options):
        docks = Chargers(
            names=tuple(map(str, range(chargers))),
            position=np.array([[10.0 * dock, 0.0] for dock in range(chargers)]),
            level=np.zeros(chargers, np.int16),
        )
        source = Charging(tasks=Poisson(rate=1), energy=Energy(battery=QUICK), **options)
        self.ledger = Ledger(source.energy, docks, robots)
        self.stream = ChargingStream(Nothing(), source, docks, self.ledger)
        self.home = np.column_stack([5.0 + np.arange(robots), np.full(robots, 50.0), np.zeros(robots)])
        self.pose, self.now = self.home.copy(), 0.0

    def step(self):
        robots = len(self.pose)
        state = State(
            pose=self.pose, twist=np.zeros((robots, 2)), level=np.zeros(robots, "i2"), contacts=np.empty((0, 2))
        )
        places = self.stream.elsewhere(self.now, state)
        self.pose = self.home.copy()
        for robot, place in places.items():
            if place is not None:
                self.pose[robot, :2] = place[:2]
        self.now += STEP
        return places

    def until(self, condition, most=1000):
        for _ in range(most):
            places = self.step()
            if condition(places):
                return places
        raise AssertionError("never")


def test_a_robot_leaves_below_the_threshold_and_returns_at_the_level():
    floor = Floor(1, 1, below=0.2, to=0.9)
    assert floor.until(lambda places: places)[0] == (0.0, 0.0, 0)
    assert floor.ledger.charge[0] == pytest.approx(0.2, abs=0.01)
    floor.until(lambda places: not places)
    assert floor.ledger.charge[0] == pytest.approx(0.9, abs=0.01)


def test_a_robot_waits_until_a_charger_is_free_and_the_emptiest_is_first():
    floor = Floor(3, 2, below=0.3, to=0.9)
    floor.ledger.charge[:] = [0.31, 0.30, 0.305]
    places = floor.until(lambda places: len(places) == 3)
    assert [robot for robot, place in places.items() if place is None] == [0]
    assert {place for place in places.values() if place} == {(0.0, 0.0, 0), (10.0, 0.0, 0)}
    after = floor.until(lambda places: places.get(0))
    assert len({place for place in after.values() if place}) == sum(place is not None for place in after.values())
    assert floor.ledger.charge[0] < 0.3, "it had to wait, and its devices went on"


def test_free_chargers_are_used_early_if_the_policy_says_so():
    floor = Floor(3, 2, below=0.1, to=0.9, early=0.6)
    floor.ledger.charge[:] = [0.5, 0.4, 0.3]
    floor.step()
    places = floor.step()
    assert sorted(places) == [1, 2], "as many as there are chargers, the emptiest first"
    assert not Floor(3, 2, below=0.1, to=0.9).step()


def test_nothing_new_is_the_same_answer_again():
    floor = Floor(2, 1, below=0.5)
    places = floor.until(len)
    assert floor.step() is places


def test_a_charger_serves_the_nearest_robot_that_stands():
    ledger = Ledger(Energy(battery=QUICK), Floor(1, 1).stream._chargers, 3)
    twist = np.zeros((3, 2))
    pose = np.array([[0.5, 0.0, 0.0], [0.2, 0.0, 0.0], [0.1, 0.0, 0.0]])
    level = np.array([0, 0, 1], np.int16)
    for now in (0.0, 0.5):
        ledger.update(now, pose, twist, level)
    assert ledger.at.tolist() == [-1, 0, -1]
    twist[1] = 0.3, 0.0
    for now in (1.0, 1.5):
        ledger.update(now, pose, twist, level)
    assert ledger.at.tolist() == [0, -1, -1], "one that drives past does not charge"


def test_levels_that_robots_could_never_leave_are_refused():
    with pytest.raises(ValueError, match="less than 'to'"):
        Charging(tasks=Poisson(rate=1), below=0.9, to=0.9)
    with pytest.raises(ValueError, match="less than 'to'"):
        Charging(tasks=Poisson(rate=1), to=0.5, early=0.6)


def world_of(*vertices):
    return World(name="hall", levels=(Level(name="floor"),), vertices=tuple(vertices))


def test_chargers_are_those_that_the_map_marks_or_that_the_study_names():
    marked = Vertex(name="dock", x=1.0, y=2.0, parameters={"is_charger": True})
    hall = world_of(Vertex(name="shelf_1", x=0.0, y=0.0), marked, Vertex(name="dock", x=1.0, y=2.0))
    assert Energy().chargers_in(hall).names == ("dock",)
    assert Energy(chargers=("shelf_*", "dock")).chargers_in(hall).names == ("shelf_1", "dock")
    assert Energy(chargers=("*",), most_chargers=1).chargers_in(hall).names == ("shelf_1",)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "marks no charger"),
        ({"chargers": ("pier",)}, "no place 'pier'"),
        ({"chargers": ("shelf_1",), "most_chargers": 2}, "has 1, not 2"),
    ],
)
def test_missing_chargers_are_one_line(options, message):
    with pytest.raises(InputError, match=message) as error:
        Energy(**options).chargers_in(world_of(Vertex(name="shelf_1", x=0.0, y=0.0)))
    assert "shelf_1" in (error.value.hint or "") or "most_chargers" in str(error.value)


def test_the_tasks_are_those_of_the_source_inside():
    args = office(), office_roadmap(), fleet(2), 3
    names = tuple(vertex.name for vertex in office().vertices if vertex.name)[:1]
    inner, outer = Poisson(rate=6), Charging(tasks=Poisson(rate=6), energy=Energy(chargers=names))
    tasks = [source.start(*args).released(600.0, 0) for source in (inner, outer)]
    goals = [[task.goals[:, :2].tolist() for task in each] for each in tasks]
    assert goals[0] == goals[1] != []
