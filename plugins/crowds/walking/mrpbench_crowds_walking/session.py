"""People under way: goals, waiting, doors and reactions; the native `Walkers` moves them."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from mrpbench_native.sim import Walkers

from mrpbench_core.api import CrowdSession, CrowdView, Mover, Movers
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World
from mrpbench_crowds_walking.detours import Detours
from mrpbench_crowds_walking.floor import Floor
from mrpbench_crowds_walking.goals import (
    REACHED,
    ActivityGoals,
    Goals,
    PlaceGoals,
    activities_on,
    shared_out,
)
from mrpbench_crowds_walking.reactions import (
    AS_OBSTACLES,
    AS_PEOPLE,
    NOT_AT_ALL,
    PATIENCE,
    SIGHT,
    nearest_seen,
    react,
)

AT_DOOR = 1.2
"""Metres from a door within which a person who walks on wants it to be open."""
ASIDE = 0.1
"""Radians by which people who avoid by velocities keep to the right."""
APART = 0.05
"""Metres between bodies where people at random places begin."""
TURNS = np.pi
"""rad/s of people who look at something."""


class WalkingSession(CrowdSession):
    """The people of one crowd; `recipe` has the options of `_Walking`, `options` those of the native code."""

    def __init__(
        self, recipe: Any, options: Mapping[str, Any], world: World, fleet: Fleet, seed: int, view: CrowdView
    ) -> None:
        if recipe.level >= len(world.levels):
            raise InputError(f"crowds: world {world.name} has no level {recipe.level}")
        recipe = attrs.evolve(recipe, given=tuple(_with_places(person, world, recipe.level) for person in recipe.given))
        self._recipe, self._seed, self._robot_radius = recipe, seed, fleet.radii
        self._floor = Floor(world, recipe.level, recipe.radius)
        self._facilities, self._level = Facilities(world), recipe.level
        self._doors = [
            (door.name, np.array([*door.door.start, *door.door.end]))
            for door in self._facilities.doors
            if door.lift is None and recipe.level in door.levels
        ]
        residents = [group for group in world.people if group.level == recipe.level] if recipe.activities else []
        usual = sum(group.people for group in residents)
        self._people = usual if recipe.people is None else recipe.people
        self._begin = shared_out(residents, self._people if residents else 0)
        count = self._people + len(recipe.given)
        self._random = [self._draws(person, 0) for person in range(count)]
        self._group = self._groups()
        self._speed = self._speeds()
        self._aside = self._turns()
        drawn = np.random.default_rng([seed % 2**64, 2**32])
        self._places = self._floor.places[drawn.integers(len(self._floor.places), size=recipe.places)]
        start = self._starts(drawn, view)
        self._goals = self._all_goals(world, start)
        self._detours = Detours(
            self._floor, recipe.radius, start, lambda person, number: self._draws(person, 2**33 + number)
        )
        self._seen_for, self._done = np.zeros(count), np.zeros(count, bool)
        leg = recipe.leg_radius if recipe.legs else 0.0
        self.members = (Mover(radius=recipe.radius, kind=recipe.kind, leg_radius=leg),) * count
        self._yaw = np.arctan2(*(self._goal - start).T[::-1])
        fastest = np.maximum(self._speed, 2.0) if recipe.reaction in ("curious", "threatening") else self._speed
        self._walkers = Walkers(
            segments=segments(world, recipe.level),
            people={
                "place": start,
                "radius": np.full(count, recipe.radius),
                "speed": fastest,
                "group": self._group.astype(np.int32),
            },
            options=dict(options),
            orca=recipe.orca,
        )
        self._wanted: set[str] = set()

    @property
    def movers(self) -> Movers:
        """Where they are now."""
        level: Int16 = np.full(len(self.members), self._level, np.int16)
        arrivals = self._arrivals.astype(np.int32)
        pose = np.column_stack([self._walkers.place, self._yaw])
        return Movers(pose=pose, velocity=self._walkers.velocity, level=level, arrivals=arrivals)

    @property
    def _goal(self) -> Float:
        """Where each of them goes f8[m,2]."""
        return np.concatenate([goals.place for goals in self._goals])

    @property
    def _arrivals(self) -> Int:
        return np.concatenate([goals.arrivals for goals in self._goals])

    def wanted_doors(self) -> set[str]:
        """Doors near people who walk towards them, and doors in which somebody stands."""
        return self._wanted

    def step(self, dt: float, view: CrowdView) -> Movers:
        """Walk for `dt` seconds."""
        place = self._walkers.place
        robots = np.flatnonzero(view.state.level == self._level)
        pose, twist = view.state.pose[robots], view.state.twist[robots]
        others = np.flatnonzero(view.others.level == self._level)
        ahead = np.column_stack([np.cos(pose[:, 2]), np.sin(pose[:, 2])])
        discs = np.vstack(
            [
                np.hstack([pose[:, :2], ahead * twist[:, :1]]),
                np.hstack([view.others.pose[others, :2], view.others.velocity[others]]),
            ]
        )
        radius = np.concatenate([self._robot_radius[robots], view.radius[others]])
        arrivals = self._arrivals
        velocity, push, regard, looks = self._wishes(dt, place, pose, radius[: len(robots)])
        arrived: Bool = np.greater(self._arrivals, arrivals)
        self._give_way(dt, place, velocity, arrived, discs[:, :2], radius)
        wishes = {"velocity": velocity, "push": push, "regard": regard}
        leaves = self._facilities.outlines(view.state.facilities, self._level) if view.state.facilities else _NO_LEAVES
        self._walkers.step(dt, wishes, discs, radius, len(robots), np.ascontiguousarray(leaves))
        self._look(dt, looks)
        self._wanted = self._doors_ahead(velocity)
        return self.movers

    def _wishes(self, dt: float, place: Float, robots: Float, radius: Float) -> tuple[Float, Float, Any, Float]:
        count = len(place)
        velocity, push, looks = np.zeros((count, 2)), np.zeros((count, 2)), np.full(count, np.nan)
        reaction = self._recipe.reaction
        regard = np.full(count, AS_OBSTACLES if reaction == "impassive" else AS_PEOPLE, np.uint8)
        away = np.hypot(*(self._goal - place).T)
        parts = np.split(away, [self._people])
        stands = np.concatenate([goals.advance(dt, part) for goals, part in zip(self._goals, parts, strict=True)])
        walking = np.flatnonzero(~stands & (away > self._recipe.radius))
        velocity[walking] = self._to_goals(place, walking)
        if reaction in SIGHT:
            alert = np.flatnonzero(~self._done)
            nearest = nearest_seen(place[alert], self._yaw[alert], robots[:, :2], SIGHT[reaction])
            who, robot = alert[nearest >= 0], nearest[nearest >= 0]
            self._tire(dt, who)
            gap = np.hypot(*(robots[robot, :2] - place[who]).T) - self._recipe.radius - radius[robot]
            acts = react(reaction, place[who], robots[robot], gap, velocity[who])
            velocity[who], push[who], looks[who] = acts
            regard[who] = NOT_AT_ALL
        return velocity, push, regard, looks

    def _to_goals(self, place: Float, walking: Int) -> Float:
        """Velocities f8[k,2] with which the people `walking` i8[k] walk on their ways."""
        way = self._detours.towards(place[walking], self._goal[walking], walking) - place[walking]
        distance = np.hypot(*way.T)[:, None]
        turned = (self._aside[walking] @ way[:, :, None])[:, :, 0]
        speed = self._speed[walking, None]
        velocity: Float = np.divide(turned, distance, out=np.zeros_like(way), where=distance > 0) * speed
        return velocity

    def _give_way(self, dt: float, place: Float, velocity: Float, arrived: Bool, discs: Float, radius: Float) -> None:
        """Let people who are blocked look for another way, past the others and the `discs` f8[k,2]."""
        for person in self._detours.update(dt, place, np.hypot(*velocity.T) > 0, arrived).tolist():
            others = np.delete(place, person, axis=0)
            self._detours.begin(
                person,
                place[person],
                self._goal[person],
                place[person] + velocity[person],
                np.vstack([others, discs]),
                np.concatenate([np.full(len(others), self._recipe.radius), radius]),
            )

    def _tire(self, dt: float, who: Int) -> None:
        """Count the time for which people see robots; they grow tired of it."""
        reaction = self._recipe.reaction
        self._seen_for[who] += dt
        tired = who[self._seen_for[who] >= PATIENCE[reaction]]
        self._seen_for[tired], self._done[tired] = 0.0, reaction != "scared"

    def _look(self, dt: float, looks: Float) -> None:
        """Turn ahead while walking, or to what a person looks at."""
        velocity = self._walkers.velocity
        moving = np.hypot(*velocity.T) > 0.1
        wanted = np.where(
            np.isnan(looks), np.where(moving, np.arctan2(velocity[:, 1], velocity[:, 0]), self._yaw), looks
        )
        turn = (wanted - self._yaw + np.pi) % (2 * np.pi) - np.pi
        self._yaw = self._yaw + np.clip(turn, -TURNS * dt, TURNS * dt)

    def _doors_ahead(self, velocity: Float) -> set[str]:
        place, wanted = self._walkers.place, set()
        for name, line in self._doors:
            gap = point_segment_distance(place, line[:2], line[2:])
            towards = ((line[:2] + line[2:]) / 2 - place) * velocity
            if ((gap < AT_DOOR) & ((towards.sum(axis=1) > 0) | (gap < 2 * self._recipe.radius))).any():
                wanted.add(name)
        return wanted

    def _draws(self, person: int, number: int) -> np.random.Generator:
        """The stream of a person for a goal: what happens to one shifts no draws of another."""
        return np.random.default_rng([self._seed % 2**64, person, int(number)])

    def _all_goals(self, world: World, start: Float) -> tuple[Goals, Goals]:
        """The goals of people who are not `given`, and of those who are."""
        recipe, (group, places), (begin, begin_own) = (
            self._recipe,
            np.split(self._group, [self._people]),
            np.split(start, [self._people]),
        )
        reach = recipe.radius + REACHED

        def drawn(person: int, number: int) -> Float:
            who = person if group[person] < 0 else int(np.flatnonzero(group == group[person])[0])
            place: Float = self._places[self._draws(who, number + 1).integers(len(self._places))]
            return place

        def stated(person: int, number: int) -> Float | None:
            goals = recipe.given[person].goals
            return np.array(goals[number % len(goals)]) if goals else None

        def draws_own(person: int, number: int) -> np.random.Generator:
            return self._draws(self._people + person, number)

        first: Goals
        if self._begin:
            activities = activities_on(world, recipe.level, self._floor)
            begun = [one.activity for one in self._begin]
            first = ActivityGoals(group, self._draws, reach, activities, begun, begin)
        else:
            first = PlaceGoals(group, self._draws, reach, drawn, begin, recipe.stay)
        return first, PlaceGoals(places, draws_own, reach, stated, begin_own, recipe.stay)

    def _groups(self) -> Int:
        """Groups i8[m], -1 = none; those that are `given` come last."""
        recipe = self._recipe
        size = recipe.group_size
        drawn = np.arange(self._people) // size if size > 1 else np.full(self._people, -1)
        first = int(drawn.max(initial=-1)) + 1
        return np.concatenate([drawn, [-1 if p.group is None else first + p.group for p in recipe.given]]).astype(int)

    def _speeds(self) -> Float:
        recipe = self._recipe
        drawn = [stream.normal(recipe.speed, recipe.speed_deviation) for stream in self._random]
        speed: Float = np.clip(np.array(drawn, float), min(0.5, recipe.speed), 2.2)
        for index, person in enumerate(recipe.given):
            if person.speed is not None:
                speed[self._people + index] = person.speed
        return speed

    def _turns(self) -> Float:
        """Rotations f8[m,2,2] of the wanted velocity, a little to the right: `orca` would stop head-on."""
        angle = [stream.normal(ASIDE, ASIDE / 4) if self._recipe.orca else 0.0 for stream in self._random]
        cosine, sine = np.cos(angle), np.sin(angle)
        rotation: Float = np.stack([cosine, sine, -sine, cosine], axis=-1).reshape(-1, 2, 2)
        return rotation

    def _starts(self, drawn: np.random.Generator, view: CrowdView) -> Float:
        """Given places first, then those near which activities begin, or random ones; no person overlaps a body.

        Raises:
            InputError: a given place is not free, or there is no room.
        """
        recipe, taken = self._recipe, []
        robots, others = view.state.level == recipe.level, view.others.level == recipe.level
        bodies = np.vstack([view.state.pose[robots, :2], view.others.pose[others, :2]])
        reach = np.concatenate([self._robot_radius[robots], view.radius[others]]) + recipe.radius
        for index, person in enumerate(recipe.given):
            for place in (person.start, *person.goals):
                if not self._floor.reaches(np.array(person.start, float), np.array(place, float)):
                    raise InputError(f"crowds: person {index} of `given` cannot walk from {person.start} to {place}")
            if not _apart(np.array(person.start), bodies, reach):
                raise InputError(
                    f"crowds: person {index} of `given` begins at {person.start}, inside a robot or a mover"
                )
            taken.append(np.array(person.start, float))
        starts: list[Float] = []
        places = self._floor.places
        orders: dict[tuple[float, ...], Iterator[Float]] = {(): iter(places[drawn.permutation(len(places))])}
        for person in range(self._people):
            near = (self._begin[person].x, self._begin[person].y) if self._begin else ()
            if near not in orders:
                orders[near] = iter(places[np.hypot(*(places - near).T).argsort(kind="stable")])
            for place in orders[near]:  # what is taken stays so
                if _apart(place, [*taken, *starts], 2 * recipe.radius + APART) and _apart(place, bodies, reach + APART):
                    starts.append(place)
                    break
            else:
                raise InputError(f"crowds: there is room for {len(starts)} of {self._people} people")
        return np.array([*starts, *taken]).reshape(-1, 2)


_NO_LEAVES = np.empty((0, 4))


def _apart(place: Float, others: Sequence[Float] | Float, distance: float | Float) -> bool:
    return not len(others) or bool((np.hypot(*(np.array(others) - place).T) >= distance).all())


def _with_places(person: Any, world: World, level: int) -> Any:
    """A person whose places are all x, y in metres."""
    named = {vertex.name: (vertex.x, vertex.y) for vertex in world.vertices if vertex.name and vertex.level == level}

    def place(of: tuple[float, float] | str) -> tuple[float, float]:
        if not isinstance(of, str):
            return of
        if of not in named:
            hint = did_you_mean(of, named, f"names are {', '.join(list(named)[:10])}")
            raise InputError(f"crowds: level {level} of world {world.name} has no place {of!r}", hint=hint)
        return named[of]

    return attrs.evolve(person, start=place(person.start), goals=tuple(map(place, person.goals)))
