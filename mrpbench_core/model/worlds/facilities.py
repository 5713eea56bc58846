"""The motion of doors and lifts. Every simulator reads from here what they do and where they are solid.

A door is one facility and has its own name. A lift is several facilities: the cabin has the lift's name, and each of
its doors is called `lift/door`. The state of a facility is one number: the opening of a door, from 0 to 1, or the
height of a cabin in metres. Leaves are solid, also while they move. A leaf that would run into a robot stops until the
robot has left.
"""

from collections import Counter
from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int16
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.worlds.doors import leaf_segments, opening_time
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Door, Lift, World

LIFT_SPEED = 1.0
"""m/s of a cabin; our estimate, because maps do not give it."""
STOREY_HEIGHT = 4.0
"""Metres between the stops of a lift whose levels do not have different elevations."""
LEVEL_TOLERANCE = 0.01
"""Largest distance in metres between a level and a cabin that is at that level."""


@attrs.frozen
class OperatedDoor:
    """A door as a facility."""

    name: str
    door: Door
    levels: tuple[int, ...]
    """The levels on which it has leaves."""
    lift: Lift | None = None
    opens_on: tuple[int, ...] = ()
    """The levels on which the door of a lift opens while the cabin is there."""


class Facilities:
    """The doors and lifts of a world. It is immutable; their state is a mapping from names to numbers."""

    def __init__(self, world: World) -> None:
        self.lifts = world.lifts
        self.heights = {lift.name: _heights(world, lift) for lift in world.lifts}
        """The height in metres of each stop: lift name -> level -> height."""
        self.doors = _operated_doors(world)
        self.names: tuple[str, ...] = (
            *(operated.name for operated in self.doors),
            *(lift.name for lift in world.lifts),
        )
        """The names of all facilities, in the order of the recording channel `facility`."""

    def initial_state(self) -> dict[str, float]:
        """Return the state in which every door is closed and every cabin is at its initial level."""
        cabins = {lift.name: self.heights[lift.name][lift.initial_level] for lift in self.lifts}
        return {operated.name: 0.0 for operated in self.doors} | cabins

    def level_of(self, lift: Lift, state: Mapping[str, float]) -> int:
        """Return the level at which a cabin is, or the nearest level while it is between two."""
        stops = self.heights[lift.name]
        return min(stops, key=lambda level: abs(stops[level] - state[lift.name]))

    def is_at(self, lift: Lift, level: int, state: Mapping[str, float]) -> bool:
        """Tell whether a cabin is at a level."""
        return level in lift.levels and abs(self.heights[lift.name][level] - state[lift.name]) <= LEVEL_TOLERANCE

    def advance(
        self,
        state: Mapping[str, float],
        commands: Mapping[str, float],
        period: float,
        pose: Float,
        level: Int16,
        radius: Float,
    ) -> dict[str, float]:
        """Return the state `period` seconds later, with robots of `radius` f8[n] at `pose` f8[n,2+] on `level` i2[n].

        `commands` maps doors to openings and cabins to heights; a facility without a command keeps its state. The
        doors and the cabin of a lift do not check one another: the commands have to be consistent.
        """
        after = dict(state)
        for operated in self.doors:
            wanted = commands.get(operated.name, state[operated.name])
            if wanted != state[operated.name]:
                opened = _towards(state[operated.name], wanted, period / opening_time(operated.door))
                here = np.isin(level, [self.level_of(operated.lift, state)] if operated.lift else operated.levels)
                if not _would_hit(operated.door, state[operated.name], opened, pose[here, :2], radius[here]):
                    after[operated.name] = opened
        for lift in self.lifts:
            wanted = commands.get(lift.name, state[lift.name])
            after[lift.name] = _towards(state[lift.name], wanted, LIFT_SPEED * period)
        return after

    def carry(self, before: Mapping[str, float], after: Mapping[str, float], pose: Float, level: Int16) -> Int16:
        """Return the levels i2[n] of robots after cabins have moved; a robot inside a cabin moves with it."""
        moved = level
        for lift in self.lifts:
            source, target = self.level_of(lift, before), self.level_of(lift, after)
            if source != target:
                aboard = np.array([lift.holds(x, y) for x, y in pose[:, :2].tolist()], bool) & (level == source)
                moved = np.where(aboard, target, moved).astype(np.int16)
        return moved

    def outlines(self, state: Mapping[str, float], level: int) -> Float:
        """Return the outlines f8[S,4] of all leaves on a level, in the form of `mrpbench_core.model.worlds.solids`."""
        parts = [
            wall_boxes(leaf_segments(operated.door, self.opening(operated, state, level)), operated.door.thickness)
            for operated in self.doors
            if level in operated.levels
        ]
        return np.concatenate([np.empty((0, 4)), *parts])

    def opening(self, operated: OperatedDoor, state: Mapping[str, float], level: int) -> float:
        """Return the opening of a door on a level. The doors of a lift are closed on levels without its cabin."""
        if operated.lift is None:
            return state[operated.name]
        there = level in operated.opens_on and self.level_of(operated.lift, state) == level
        return state[operated.name] if there else 0.0


def ride_time(world: World, lift: Lift, start: int, end: int) -> float:
    """Return the seconds from open doors on one level to open doors on another."""
    stops = _heights(world, lift)
    doors = max((opening_time(door) for door in lift.doors), default=0.0)
    return 2 * doors + abs(stops[start] - stops[end]) / LIFT_SPEED


def _heights(world: World, lift: Lift) -> dict[int, float]:
    stops = {level: world.levels[level].elevation for level in lift.levels}
    if len(set(stops.values())) < len(stops):
        return {level: STOREY_HEIGHT * index for index, level in enumerate(sorted(stops))}
    return stops


def _operated_doors(world: World) -> tuple[OperatedDoor, ...]:
    drawn = [
        (level, index, door) for level, storey in enumerate(world.levels) for index, door in enumerate(storey.doors)
    ]
    count = Counter([door.name for *_, door in drawn] + [lift.name for lift in world.lifts])
    operated_doors = []
    for level, index, door in drawn:
        clear = door.name and count[door.name] == 1
        operated_doors.append(
            OperatedDoor(door.name if clear else f"{world.levels[level].name}/{door.name}#{index}", door, (level,))
        )
    for lift in world.lifts:
        for door, opens_on in zip(lift.doors, lift.door_levels, strict=True):
            operated_doors.append(OperatedDoor(f"{lift.name}/{door.name}", door, lift.levels, lift, opens_on))
    return tuple(operated_doors)


def _towards(value: float, wanted: float, step: float) -> float:
    return wanted if abs(wanted - value) <= step else value + step * (1 if wanted > value else -1)


def _would_hit(door: Door, before: float, after: float, place: Float, radius: Float) -> bool:
    """Tell whether the leaves would touch a robot at `place` f8[n,2] and get closer to it than they are."""
    if not len(place):
        return False
    old, new = (_gap(leaf_segments(door, opening), place) for opening in (before, after))
    touching: Bool = (new < radius + door.thickness / 2) & (new < old)
    return bool(touching.any())


def _gap(lines: Float, place: Float) -> Float:
    gap: Float = point_segment_distance(place[:, None], lines[:, :2], lines[:, 2:]).min(axis=1)
    return gap
