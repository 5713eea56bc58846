"""Reads from a recording when doors open and close, and when lifts leave and arrive."""

from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.worlds.facilities import LEVEL_TOLERANCE, Facilities
from mrpbench_core.model.worlds.world import World
from mrpbench_core.store.recording import Recording


def read_facility_events(recording: Recording, world: World) -> list[list[Any]]:
    """Return the motions of doors and lifts as [seconds, kind, -1, detail].

    The kinds are `door_opens`, `door_closes`, `lift_leaves` and `lift_arrives`; the detail is the name of the door or
    lift, for lifts with the level.
    """
    facilities = Facilities(world)
    if "facility" not in recording.channels or not facilities.names:
        return []
    times, states = recording.channel("time"), recording.channel("facility")
    events: list[list[Any]] = []
    for door, opening in zip(facilities.doors, states.T, strict=False):
        change = np.sign(np.diff(opening))
        begins = np.flatnonzero((change != 0) & (change != np.append(0, change[:-1])))
        kinds = ("door_opens" if change[at] > 0 else "door_closes" for at in begins)
        events += [[float(times[at]), kind, -1, door.name] for at, kind in zip(begins, kinds, strict=True)]
    for lift, height in zip(world.lifts, states.T[len(facilities.doors) :], strict=True):
        events += _rides(lift.name, facilities.heights[lift.name], world, times, height)
    return [[round(time, 3), *rest] for time, *rest in events]


def _rides(name: str, heights: dict[int, float], world: World, times: Float, height: Float) -> list[list[Any]]:
    stops = np.array(list(heights.values()))
    near = np.abs(height[:, None] - stops)
    moves = np.append(False, np.abs(np.diff(height)) > LEVEL_TOLERANCE / 10)
    rides = []
    for at in np.flatnonzero(moves[1:] != moves[:-1]):
        level = list(heights)[int(near[at].argmin())]
        kind = "lift_arrives" if moves[at] else "lift_leaves"
        rides.append([float(times[at]), kind, -1, f"{name}, {world.levels[level].name or f'level {level}'}"])
    return rides
