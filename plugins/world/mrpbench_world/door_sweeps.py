"""Finds lanes and cells that the leaves of doors sweep, and doors before which robots have no place to wait."""

from collections.abc import Iterator

import numpy as np

from mrpbench_core.checking.clearance import touches
from mrpbench_core.checking.components import components
from mrpbench_core.checking.navigation import called, unique_edges
from mrpbench_core.files.text import counted
from mrpbench_core.model.common.geometry import side as which_side
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.worlds.doors import swept_areas
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.world import World


def check_door_sweeps(world: World, roadmap: Roadmap, radius: float) -> list[str]:
    """Return a sentence for each lane that a leaf sweeps and that does not lead through the doorway, for the swept
    cells of each door, and for each door without a place to wait outside of its resource. Doors that no route passes do
    not count, because they stay closed.

    Args:
        world: has the doors and lanes.
        roadmap: says which doors are in use.
        radius: of the largest robot, metres.
    """
    used = {resource.name: resource for resource in roadmap.resources if resource.kind == "door"}
    faults: list[str] = []
    for operated in Facilities(world).doors:
        if operated.name in used:
            faults += _swept_lanes(world, operated, radius)
            if roadmap.grid is not None:
                faults += _swept_cells(roadmap, operated, radius)
            faults += _without_waiting_place(world, roadmap, operated, used[operated.name])
    return faults


def _swept_lanes(world: World, operated: OperatedDoor, radius: float) -> Iterator[str]:
    doorway, leaves = np.array([operated.door.start, operated.door.end]), swept_areas(operated.door)
    for a, b in unique_edges(world):
        first, last = world.vertices[a], world.vertices[b]
        if first.level != last.level or first.level not in operated.levels:
            continue
        start, end = np.array([[first.x, first.y]]), np.array([[last.x, last.y]])
        swept = any(touches(leaf, start, end, radius)[0] for leaf in leaves)
        if swept and not touches(doorway, start, end, radius)[0]:
            yield (
                f"the leaf of door {operated.name} sweeps lane {called(world, a)} – {called(world, b)}, so that robots "
                "on it wait while the door moves: move the lane, or let the door open to the other side"
            )


def _swept_cells(roadmap: Roadmap, operated: OperatedDoor, radius: float) -> Iterator[str]:
    doorway, leaves = np.array([operated.door.start, operated.door.end]), swept_areas(operated.door)
    place = roadmap.position[np.isin(roadmap.level, operated.levels)]
    swept = np.zeros(len(place), bool)
    for leaf in leaves:
        swept |= touches(leaf, place, place, radius)
    count = int((swept & ~touches(doorway, place, place, radius)).sum())
    if count:
        yield (
            f"the leaf of door {operated.name} sweeps {counted(count, 'cell')}, so that robots there wait while the "
            "door moves: let the door open to the other side if robots pass there"
        )


def _without_waiting_place(world: World, roadmap: Roadmap, operated: OperatedDoor, resource: Resource) -> Iterator[str]:
    """On each side of a doorway, follow the lanes from there to the first vertices outside of the resource."""
    start, end = np.array(operated.door.start), np.array(operated.door.end)
    side = np.sign(which_side(start, end, roadmap.position))
    inside = np.isin(np.arange(len(side)), resource.vertices)
    ends = roadmap.edges[side[roadmap.edges[:, 0]] == side[roadmap.edges[:, 1]]]
    label = components(len(side), ends[inside[ends].any(axis=1)])
    begins = np.unique(roadmap.edges[list(resource.passage)])
    for way in (-1, 1):
        here = begins[side[begins] == way]
        if len(here) and not np.isin(label[~inside], label[here]).any():
            (x, y), level = roadmap.position[here[0]], world.levels[int(roadmap.level[here[0]])].name
            where = f"({x:.2f}, {y:.2f})" + (f" on level {level}" if len(world.levels) > 1 else "")
            yield (
                f"door {operated.name} has no place to wait on the side of {where}, because the lanes end where its "
                "leaf opens: add a vertex farther from the door"
            )
