"""Doors and lifts of a world as resources of a roadmap.

The resource of a door holds every vertex and edge near its doorway or near the area that its leaves sweep, so that a
robot waits outside of that area. The edges through the doorway need an open door, the others a closed one. Edges that
an open leaf would block are left out. A door without an edge through its doorway always stays closed. The resource of
a lift holds its cabin on every level and the edges into it.
"""

import math

import attrs
import numpy as np

from mrpbench_core.builtin.roadmaps.open_doors import avoid_open_doors
from mrpbench_core.builtin.roadmaps.proximity import MARGIN, elements_near, select_edges
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.worlds.doors import opening_time, swept_areas
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor, ride_time
from mrpbench_core.model.worlds.world import Lift, World


def with_facilities(roadmap: Roadmap, world: World, radius: float) -> Roadmap:
    """Return the roadmap with edges for lifts and a resource for each door and lift.

    Args:
        roadmap: without doors and lifts.
        world: whose doors and lifts they are.
        radius: the largest of the robots, metres.
    """
    if not any(level.doors for level in world.levels) and not world.lifts:
        return roadmap
    roadmap, notes = avoid_open_doors(_with_lift_edges(roadmap, world), world, radius)
    facilities = Facilities(world)
    operated_resources = [_door(operated, roadmap, radius) for operated in facilities.doors if operated.lift is None]
    operated_resources += [_lift(lift, world, roadmap, radius) for lift in world.lifts]
    clashing = [
        attrs.evolve(mutex, name=f"mutex {mutex.name}") if mutex.name in facilities.names else mutex
        for mutex in roadmap.resources
    ]
    return attrs.evolve(
        roadmap,
        resources=(*clashing, *(resource for resource in operated_resources if resource is not None)),
        notes=(*roadmap.notes, *notes),
    )


def _door(operated: OperatedDoor, roadmap: Roadmap, radius: float) -> Resource | None:
    doorway = np.array([operated.door.start, operated.door.end])
    _, edges = elements_near([doorway], roadmap, operated.levels, radius)
    if not len(edges):
        return None
    around = elements_near([doorway, *swept_areas(operated.door)], roadmap, operated.levels, radius + MARGIN)
    return Resource(
        name=operated.name,
        kind="door",
        vertices=tuple(around[0].tolist()),
        edges=tuple(around[1].tolist()),
        setup_ticks=math.ceil(opening_time(operated.door) / roadmap.tick),
        passage=tuple(edges.tolist()),
    )


def _lift(lift: Lift, world: World, roadmap: Roadmap, radius: float) -> Resource | None:
    rides = _rides(lift, roadmap)
    if not len(rides):
        return None
    entrances = [np.array([door.start, door.end]) for door in lift.doors]
    vertices, edges = elements_near([lift.corners, *entrances], roadmap, lift.levels, radius + MARGIN)
    longest = max(ride_time(world, lift, start, end) for start in lift.levels for end in lift.levels)
    return Resource(
        name=lift.name,
        kind="lift",
        vertices=tuple(vertices.tolist()),
        edges=tuple(np.union1d(edges, rides).tolist()),
        setup_ticks=math.ceil(longest / roadmap.tick),
    )


def _with_lift_edges(roadmap: Roadmap, world: World) -> Roadmap:
    """Return the roadmap with an edge for every ride, between the vertices nearest to the middle of the cabin."""
    edges, ticks = [], []
    for lift in world.lifts:
        stops = {level: _stop(lift, level, world, roadmap) for level in lift.levels}
        for start, tail in stops.items():
            for end, head in stops.items():
                if start != end and tail >= 0 and head >= 0:
                    edges.append((tail, head))
                    ticks.append(math.ceil(ride_time(world, lift, start, end) / roadmap.tick - 1e-9))
    if not edges:
        return roadmap
    rides = np.broadcast_to(np.array(ticks, np.int32), (len(roadmap.duration), len(ticks)))
    all_edges = np.concatenate([roadmap.edges, np.array(edges, np.int32)])
    duration = np.concatenate([roadmap.duration, rides], axis=1)
    longer = attrs.evolve(roadmap, edges=all_edges, duration=duration)
    return select_edges(longer, np.lexsort((all_edges[:, 1], all_edges[:, 0])))


def _stop(lift: Lift, level: int, world: World, roadmap: Roadmap) -> int:
    """Return the vertex in a cabin on a level; -1 means that there is none."""
    places = [
        (math.dist((vertex.x, vertex.y), (lift.x, lift.y)), int(roadmap.place[index]))
        for index, vertex in enumerate(world.vertices)
        if vertex.level == level and vertex.lift == lift.name and roadmap.place[index] >= 0
    ]
    return min(places)[1] if places else -1


def _rides(lift: Lift, roadmap: Roadmap) -> Int:
    """Return the edges of a lift that lead from one level to another."""
    start, end = roadmap.edges[:, 0], roadmap.edges[:, 1]
    served = np.isin(roadmap.level, lift.levels)
    between = np.flatnonzero((roadmap.level[start] != roadmap.level[end]) & served[start] & served[end])
    inside = np.array([lift.holds(x, y) for x, y in roadmap.position[start[between]].tolist()], bool)
    rides: Int = between[inside]
    return rides
