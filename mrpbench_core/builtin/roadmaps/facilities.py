"""Doors and lifts of a world as resources of a roadmap.

A door's resource is all that comes near its doorway or what its leaves sweep, so that a robot waits out of their way;
what leads through the doorway needs it open, the rest needs it shut. Where an open leaf would be in a robot's way, no
edge leads. A door that no edge leads through stays shut for ever. A lift's resource is its cabin on every level with
the ways into it.
"""

import math

import attrs
import numpy as np

from mrpbench_core.checking.clearance import touches
from mrpbench_core.model.arrays import Bool, Float, Int
from mrpbench_core.model.doors import leaves, opening_time, swept
from mrpbench_core.model.facilities import Facilities, Gate, ride_time
from mrpbench_core.model.roadmap import Resource, Roadmap
from mrpbench_core.model.solids import wall_boxes
from mrpbench_core.model.world import Lift, World

MARGIN = 0.1
"""metres by which a robot may be off its place: the tolerance of navigators."""


def clear_of_open_doors(world: World, level: int, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether a disc that moves from `start` to `end` f8[k,2] through doors touches no open leaf."""
    clear = np.ones(len(start), bool)
    for door in world.levels[level].doors:
        passing = touches(np.array([door.start, door.end]), start, end, radius)
        for box in wall_boxes(leaves(door, 1.0), door.thickness).reshape(-1, 4, 4)[:, :, :2]:
            clear &= ~(passing & touches(box, start, end, radius))
    return clear


def with_facilities(roadmap: Roadmap, world: World, radius: float) -> Roadmap:
    """The roadmap with edges for lifts and a resource for each door and lift; `radius` in metres is the largest."""
    if not any(level.doors for level in world.levels) and not world.lifts:
        return roadmap
    roadmap = _with_lift_edges(roadmap, world)
    facilities = Facilities(world)
    found = [_door(gate, roadmap, radius) for gate in facilities.gates if gate.lift is None]
    found += [_lift(lift, world, roadmap, radius) for lift in world.lifts]
    clashing = [
        attrs.evolve(mutex, name=f"mutex {mutex.name}") if mutex.name in facilities.names else mutex
        for mutex in roadmap.resources
    ]
    return attrs.evolve(roadmap, resources=(*clashing, *(resource for resource in found if resource is not None)))


def _door(gate: Gate, roadmap: Roadmap, radius: float) -> Resource | None:
    doorway = np.array([gate.door.start, gate.door.end])
    _, edges = _near([doorway], roadmap, gate.levels, radius)
    if not len(edges):
        return None
    around = _near([doorway, *swept(gate.door)], roadmap, gate.levels, radius + MARGIN)
    return Resource(
        name=gate.name,
        kind="door",
        vertices=tuple(around[0].tolist()),
        edges=tuple(around[1].tolist()),
        setup_ticks=math.ceil(opening_time(gate.door) / roadmap.tick),
        passage=tuple(edges.tolist()),
    )


def _lift(lift: Lift, world: World, roadmap: Roadmap, radius: float) -> Resource | None:
    rides = _rides(lift, roadmap)
    if not len(rides):
        return None
    entrances = [np.array([door.start, door.end]) for door in lift.doors]
    vertices, edges = _near([lift.corners, *entrances], roadmap, lift.levels, radius + MARGIN)
    longest = max(ride_time(world, lift, start, end) for start in lift.levels for end in lift.levels)
    return Resource(
        name=lift.name,
        kind="lift",
        vertices=tuple(vertices.tolist()),
        edges=tuple(np.union1d(edges, rides).tolist()),
        setup_ticks=math.ceil(longest / roadmap.tick),
    )


def _near(outlines: list[Float], roadmap: Roadmap, levels: tuple[int, ...], radius: float) -> tuple[Int, Int]:
    """Vertices and edges on some levels at which a disc touches any of `outlines`."""
    here = np.isin(roadmap.level, levels)
    start, end = roadmap.edges[:, 0], roadmap.edges[:, 1]
    flat = here[start] & here[end] & (roadmap.level[start] == roadmap.level[end])
    vertices, edges = np.flatnonzero(here), np.flatnonzero(flat)
    at, a, b = roadmap.position[vertices], roadmap.position[start[edges]], roadmap.position[end[edges]]
    stands, drives = np.zeros(len(at), bool), np.zeros(len(a), bool)
    for outline in outlines:
        stands |= touches(outline, at, at, radius)
        drives |= touches(outline, a, b, radius)
    return vertices[stands], edges[drives]


def _with_lift_edges(roadmap: Roadmap, world: World) -> Roadmap:
    """With an edge for every ride, from the place in a cabin that is nearest to its middle to that on another level."""
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
    all_edges = np.concatenate([roadmap.edges, np.array(edges, np.int32)])
    rides = np.broadcast_to(np.array(ticks, np.int32), (len(roadmap.duration), len(ticks)))
    order = np.lexsort((all_edges[:, 1], all_edges[:, 0]))
    duration = np.concatenate([roadmap.duration, rides], axis=1)[:, order]
    return attrs.evolve(roadmap, edges=all_edges[order], duration=duration)


def _stop(lift: Lift, level: int, world: World, roadmap: Roadmap) -> int:
    """The vertex in a cabin on a level, -1 = none."""
    places = [
        (math.dist((vertex.x, vertex.y), (lift.x, lift.y)), int(roadmap.place[index]))
        for index, vertex in enumerate(world.vertices)
        if vertex.level == level and vertex.lift == lift.name and roadmap.place[index] >= 0
    ]
    return min(places)[1] if places else -1


def _rides(lift: Lift, roadmap: Roadmap) -> Int:
    """The edges of a lift, which lead from one level to another."""
    start, end = roadmap.edges[:, 0], roadmap.edges[:, 1]
    between = np.flatnonzero(roadmap.level[start] != roadmap.level[end])
    inside = np.array([lift.holds(x, y) for x, y in roadmap.position[start[between]].tolist()], bool)
    rides: Int = between[inside]
    return rides
