"""Where people go next: from place to place, or as the activities of the world say."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.worlds.routines import Activity, PeopleGroup
from mrpbench_core.model.worlds.world import World
from mrpbench_crowds_walking.floor import Floor

REACHED = 0.4
"""Metres from a goal, in addition to the radius, at which a person is there."""
Generators = Callable[[int, int], np.random.Generator]
"""The random stream of a person for the goal of a number."""


class Goals(ABC):
    """The goals of k people, one after the other; a group goes together, as its first person does.

    Args:
        group: i8[k] numbers of groups, -1 = alone.
        draws: random streams.
        reach: metres from a goal at which a person is there.
    """

    place: Float
    """f8[k,2] where they go now."""
    arrivals: Int
    """i8[k] number of goals that each has reached, -1 = has none."""

    def __init__(self, group: Int, draws: Generators, reach: float) -> None:
        self._draws, self._reach = draws, reach
        self._together = [
            np.array([person]) if of < 0 else np.flatnonzero(group == of) for person, of in enumerate(group.tolist())
        ]

    def _stream(self, person: int, number: int) -> np.random.Generator:
        return self._draws(int(self._together[person][0]), number)

    @abstractmethod
    def advance(self, dt: float, away: Float) -> Bool:
        """Let `dt` seconds pass, and return who b1[k] stands; `away` f8[k] metres are those to the goals."""


class PlaceGoals(Goals):
    """Goals that follow one another, with a stay at each.

    Args:
        following: gives the goal f8[2] of a person by its number, None = the person has no goals.
        starts: f8[k,2] where those are who have no goals.
        stay: mean seconds at a goal.
    """

    def __init__(
        self,
        group: Int,
        draws: Generators,
        reach: float,
        following: Callable[[int, int], Float | None],
        starts: Float,
        stay: float,
    ) -> None:
        super().__init__(group, draws, reach)
        self._following, self._stay = following, stay
        first = [following(person, 0) for person in range(len(group))]
        self._has_goals = np.array([goal is not None for goal in first], bool)
        self.place = np.array(
            [start if goal is None else goal for goal, start in zip(first, starts, strict=True)], float
        ).reshape(-1, 2)
        self.arrivals = np.where(self._has_goals, 0, -1)
        self._waits = np.zeros(len(group))

    def advance(self, dt: float, away: Float) -> Bool:
        """Stay for a while at each goal, then go to the next one."""
        self._waits = np.maximum(self._waits - dt, 0.0)
        for person in np.flatnonzero((away < self._reach) & self._has_goals).tolist():
            if self._waits[person] == 0:
                self._arrive(person)
        return self._waits > 0

    def _arrive(self, person: int) -> None:
        for member in self._together[person].tolist():
            self.arrivals[member] += 1
            number = int(self.arrivals[member])
            self._waits[member] = self._stream(member, number).exponential(self._stay) if self._stay else 0.0
            goal = self._following(member, number)
            assert goal is not None
            self.place[member] = goal


class ActivityGoals(Goals):
    """Goals and stays as the activities of the world say.

    Args:
        activities: of the world, with those of their places to which people come on the level.
        first: the index of the activity with which each person begins.
        starts: f8[k,2] where they begin.
    """

    def __init__(
        self,
        group: Int,
        draws: Generators,
        reach: float,
        activities: Sequence[Activity],
        first: Sequence[int],
        starts: Float,
    ) -> None:
        super().__init__(group, draws, reach)
        count = len(group)
        self._activities = activities
        self.place, self.arrivals = starts.copy(), np.zeros(count, int)
        self._activity, self._number = np.zeros(count, int), np.zeros(count, int)
        self._near = np.zeros(count)
        self._there = np.zeros(count, bool)
        self._left = np.zeros(count)
        for person, activity in enumerate(first):
            self._begin(person, activity)

    def advance(self, dt: float, away: Float) -> Bool:
        """Go on with the next activity where one has ended."""
        self._left -= dt
        new = ~self._there & (away < self._near)
        self._there |= new
        self.arrivals += new
        gone_on: set[int] = set()
        for person in np.flatnonzero(self._there | (self._left <= 0)).tolist():
            if person not in gone_on and (chosen := self._next(person)) is not None:
                gone_on.update(self._together[person].tolist())
                for member in self._together[person].tolist():
                    self._begin(member, chosen)
        return self._there.copy()

    def _next(self, person: int) -> int | None:
        """The activity that follows, None if that of now goes on."""
        activity = self._activities[self._activity[person]]
        ends = [] if activity.reach is None else [bool(self._there[person])]
        ends += [] if activity.time is None else [bool(self._left[person] <= 0)]
        if not ends or not (any(ends) if activity.either else all(ends)) or not activity.following:
            return None
        choices, weights = zip(*activity.following, strict=True)
        share = self._stream(person, int(self._number[person]) + 1).random() * sum(weights)
        return int(choices[min(int((np.cumsum(weights) <= share).sum()), len(choices) - 1)])

    def _begin(self, person: int, number: int) -> None:
        """Begin an activity; what is drawn does not depend on when."""
        activity = self._activities[number]
        self._activity[person] = number
        self._number[person] += 1
        _, time, place = self._stream(person, int(self._number[person])).random(3).tolist()
        self._left[person] = np.inf
        if activity.time is not None:
            low, high = activity.time
            self._left[person] = low + (high - low) * time
        self._there[person] = not len(activity.places)
        if len(activity.places):
            self._near[person] = max(activity.reach or 0.0, self._reach)
            self.place[person] = activity.places[int(place * len(activity.places))]


def activities_on(world: World, level: int, floor: Floor) -> tuple[Activity, ...]:
    """Return the activities of the world with those of their places to which people come on a level.

    Activities that have no such place follow no other.

    Raises:
        InputError: people on this level begin with such an activity.
    """
    activities = []
    for activity in world.activities:
        here = [floor.nearest(place) for place in activity.places[activity.level == level]]
        places = np.array([place for place in here if place is not None], float).reshape(-1, 2)
        activities.append(attrs.evolve(activity, places=places, level=np.full(len(places), level, np.int16)))
    lost = {
        index
        for index, (before, after) in enumerate(zip(world.activities, activities, strict=True))
        if len(before.places) and not len(after.places)
    }
    for group in world.people:
        if group.level == level and group.activity in lost:
            name = world.activities[group.activity].name
            raise InputError(f"crowds: nobody comes to a place of {name!r} on level {level} of world {world.name}")
    return tuple(
        attrs.evolve(activity, following=tuple(pair for pair in activity.following if pair[0] not in lost))
        for activity in activities
    )


def shared_out(groups: Sequence[PeopleGroup], count: int) -> list[PeopleGroup]:
    """Return the group of each of `count` people, so that each group has its share (A. Sainte-Laguë, 1910)."""
    has = [0] * len(groups)
    chosen = []
    for _ in range(count):
        best = max(range(len(groups)), key=lambda index: groups[index].people / (2 * has[index] + 1))
        has[best] += 1
        chosen.append(groups[best])
    return chosen
