"""Doors and lifts in motion: the one place in which every simulator reads what they do and where they are solid.

A door is a facility by its name. A lift is several: its cabin by the lift's name, and each of its doors as
`lift/door`. What a facility does is one number: of a door how far it is open, 0..1, of a cabin its height in metres.
Leaves are solid wherever they are, also while they move; a leaf that would run into a robot stops until it is gone.
"""

from collections import Counter
from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.model.arrays import Bool, Float, Int16
from mrpbench_core.model.doors import leaves, opening_time
from mrpbench_core.model.geometry import point_segment_distance
from mrpbench_core.model.solids import wall_boxes
from mrpbench_core.model.world import Door, Lift, World

LIFT_SPEED = 1.0
"""m/s of a cabin; our estimate, as maps say nothing."""
STOREY = 4.0
"""Metres between the stops of a lift whose levels have no elevations of their own."""
LEVEL = 0.01
"""Metres by which a cabin may miss a level and still be there."""


@attrs.frozen
class Gate:
    """A door as a facility."""

    name: str
    door: Door
    levels: tuple[int, ...]
    """Where its leaves are."""
    lift: Lift | None = None
    opens_on: tuple[int, ...] = ()
    """Where the door of a lift opens, when the cabin is there."""


class Facilities:
    """The doors and lifts of a world. Immutable: what they do at a time is a mapping of names to numbers."""

    def __init__(self, world: World) -> None:
        self.lifts = world.lifts
        self.heights = {lift.name: _heights(world, lift) for lift in world.lifts}
        """Metres at which each lift stops, by level."""
        self.gates = _gates(world)
        self.names: tuple[str, ...] = (*(gate.name for gate in self.gates), *(lift.name for lift in world.lifts))
        """All facilities, in the order of the channel `facility` of recordings."""

    def initial(self) -> dict[str, float]:
        """Every door shut, every cabin on its initial level."""
        cabins = {lift.name: self.heights[lift.name][lift.initial_level] for lift in self.lifts}
        return {gate.name: 0.0 for gate in self.gates} | cabins

    def level_of(self, lift: Lift, state: Mapping[str, float]) -> int:
        """The level at which a cabin is or, between two, the nearer."""
        stops = self.heights[lift.name]
        return min(stops, key=lambda level: abs(stops[level] - state[lift.name]))

    def stands_at(self, lift: Lift, level: int, state: Mapping[str, float]) -> bool:
        """Tell whether a cabin is at a level."""
        return level in lift.levels and abs(self.heights[lift.name][level] - state[lift.name]) <= LEVEL

    def advance(
        self,
        state: Mapping[str, float],
        commands: Mapping[str, float],
        period: float,
        pose: Float,
        level: Int16,
        radius: Float,
    ) -> dict[str, float]:
        """What all do `period` seconds later, among robots at `pose` f8[n,2+] on `level` i2[n].

        `commands` give openings for doors and heights for cabins; what has none stays as it is. Doors and cabins of a
        lift do not watch one another: who commands them does.
        """
        after = dict(state)
        for gate in self.gates:
            wanted = commands.get(gate.name, state[gate.name])
            if wanted != state[gate.name]:
                opened = _towards(state[gate.name], wanted, period / opening_time(gate.door))
                here = np.isin(level, [self.level_of(gate.lift, state)] if gate.lift else gate.levels)
                if not _runs_into(gate.door, state[gate.name], opened, pose[here, :2], radius[here]):
                    after[gate.name] = opened
        for lift in self.lifts:
            wanted = commands.get(lift.name, state[lift.name])
            after[lift.name] = _towards(state[lift.name], wanted, LIFT_SPEED * period)
        return after

    def carried(self, before: Mapping[str, float], after: Mapping[str, float], pose: Float, level: Int16) -> Int16:
        """The levels i2[n] of robots once cabins have moved: who is in one comes with it."""
        moved = level
        for lift in self.lifts:
            source, target = self.level_of(lift, before), self.level_of(lift, after)
            if source != target:
                aboard = np.array([lift.holds(x, y) for x, y in pose[:, :2].tolist()], bool) & (level == source)
                moved = np.where(aboard, target, moved).astype(np.int16)
        return moved

    def outlines(self, state: Mapping[str, float], level: int) -> Float:
        """Outlines f8[S,4] of all leaves on a level, solid on their left as in `mrpbench_core.model.solids`."""
        parts = [
            wall_boxes(leaves(gate.door, self.opening(gate, state, level)), gate.door.thickness)
            for gate in self.gates
            if level in gate.levels
        ]
        return np.concatenate([np.empty((0, 4)), *parts])

    def opening(self, gate: Gate, state: Mapping[str, float], level: int) -> float:
        """How far a door is open on a level: the doors of a lift are shut where the cabin is not."""
        if gate.lift is None:
            return state[gate.name]
        there = level in gate.opens_on and self.level_of(gate.lift, state) == level
        return state[gate.name] if there else 0.0


def ride_time(world: World, lift: Lift, start: int, end: int) -> float:
    """Seconds from doors open on one level to doors open on another."""
    stops = _heights(world, lift)
    doors = max((opening_time(door) for door in lift.doors), default=0.0)
    return 2 * doors + abs(stops[start] - stops[end]) / LIFT_SPEED


def _heights(world: World, lift: Lift) -> dict[int, float]:
    stops = {level: world.levels[level].elevation for level in lift.levels}
    if len(set(stops.values())) < len(stops):
        return {level: STOREY * index for index, level in enumerate(sorted(stops))}
    return stops


def _gates(world: World) -> tuple[Gate, ...]:
    drawn = [
        (level, index, door) for level, storey in enumerate(world.levels) for index, door in enumerate(storey.doors)
    ]
    count = Counter([door.name for *_, door in drawn] + [lift.name for lift in world.lifts])
    gates = []
    for level, index, door in drawn:
        clear = door.name and count[door.name] == 1
        gates.append(Gate(door.name if clear else f"{world.levels[level].name}/{door.name}#{index}", door, (level,)))
    for lift in world.lifts:
        for door, opens_on in zip(lift.doors, lift.door_levels, strict=True):
            gates.append(Gate(f"{lift.name}/{door.name}", door, lift.levels, lift, opens_on))
    return tuple(gates)


def _towards(value: float, wanted: float, step: float) -> float:
    return wanted if abs(wanted - value) <= step else value + step * (1 if wanted > value else -1)


def _runs_into(door: Door, before: float, after: float, place: Float, radius: Float) -> bool:
    """Tell whether a door's leaves come nearer to a robot f8[n,2] that they touch then."""
    if not len(place):
        return False
    old, new = (_gap(leaves(door, opening), place) for opening in (before, after))
    touching: Bool = (new < radius + door.thickness / 2) & (new < old)
    return bool(touching.any())


def _gap(lines: Float, place: Float) -> Float:
    gap: Float = point_segment_distance(place[:, None], lines[:, :2], lines[:, 2:]).min(axis=1)
    return gap
