"""The roadmap `graph`: the navigation graph, with durations from lengths and speeds."""

import attrs
import numpy as np

from mrpbench_core.api.component import between, option
from mrpbench_core.builtin.roadmaps.facilities import with_facilities
from mrpbench_core.builtin.roadmaps.junctions import LaneSegments, cut_at_junctions
from mrpbench_core.builtin.roadmaps.motion import KINODYNAMIC_TICK, TimedRoadmap, driving_ticks
from mrpbench_core.builtin.roadmaps.open_doors import clears_open_doors
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.navigation import called
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.worlds.world import Lane, World


@attrs.frozen(kw_only=True)
class Graph(TimedRoadmap):
    """Vertices are places and junctions of lanes, edges are lanes of the RMF navigation graphs. A robot that is bound
    to a graph (`fleet: [{robot: …, graph: 0}]`) uses the lanes of that graph only.

    The duration of an edge is its length divided by the lower of its lane's speed limit and the robot's top speed,
    rounded up to ticks. In half a second a small robot drives 0.1 m: rounding matters little on lanes of a metre, and a
    plan of minutes has a few hundred ticks.
    """

    tick: float | None = option(
        None,
        help="Time step of durations; by default 0.5 s, or 0.1 s if they are kinodynamic.",
        unit="s",
        validator=attrs.validators.optional(between(0.001, 60)),
    )
    tolerance: float = option(
        0.2,
        help="A lane that passes a vertex nearer than this leads through it; vertices nearer to one another are one.",
        unit="m",
        validator=attrs.validators.gt(0),
    )

    def build(self, world: World, fleet: Fleet) -> Roadmap:
        """Cut the lanes of each level at their junctions and leave out those on which no robot can drive."""
        if not world.lanes:
            raise InputError(f"world {world.name!r} has no lanes", hint="try roadmap: grid")
        tick = self.tick or (KINODYNAMIC_TICK if self.is_kinodynamic else 0.5)
        pieces, level = _cut(world, self.tolerance)
        profiles = self.profiles(fleet)
        smallest = min(robot.radius for robot in profiles)
        stands = _clear(world, level, pieces.position, pieces.position, smallest)
        offered: Bool = np.stack([_lanes_of(world, robot)[pieces.lane] for robot in profiles])
        duration = np.stack([_ticks(world, pieces, level, robot, tick) for robot in profiles])
        duration = np.where(offered, duration, -1)
        drivable = (duration >= 0).any(axis=0) & stands[pieces.ends[:, 0]] & stands[pieces.ends[:, 1]]
        edges, duration = _directed(pieces, world.lanes, duration, drivable)
        if not len(edges):
            raise InputError(f"world {world.name!r} has no lane that a robot fits on")
        number = np.where(stands, np.cumsum(stands) - 1, -1)
        roadmap = Roadmap(
            position=pieces.position[stands],
            level=level[stands].astype(np.int16),
            heading=np.full(stands.sum(), np.nan),
            edges=number[edges],
            duration=duration.astype(np.int32),
            tick=tick,
            place=number[pieces.vertex],
            resources=_mutexes(world, pieces, number, number[edges]),
            notes=(*_notes(world, pieces, drivable, np.any(offered, axis=0)), *_lost(world, number[pieces.vertex] < 0)),
        )
        return self.timed(with_facilities(roadmap, world, float(fleet.radii.max())), profiles)


def _cut(world: World, tolerance: float) -> tuple[LaneSegments, Int]:
    """Return the segments of the lanes of all levels, and the level i8[V] of each of their vertices."""
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices])
    storey = np.array([vertex.level for vertex in world.vertices])
    drawn = np.array([(lane.start, lane.end) for lane in world.lanes], np.int64)
    vertex = np.zeros(len(point), np.int64)
    positions: list[Float] = []
    ends: list[Int] = []
    lanes: list[Int] = []
    levels: list[Int] = []
    for level in np.unique(storey):
        here, ours = np.flatnonzero(storey == level), np.flatnonzero(storey[drawn[:, 0]] == level)
        number = np.cumsum(storey == level) - 1
        pieces = cut_at_junctions(point[here], number[drawn[ours]], tolerance)
        first = sum(len(position) for position in positions)
        positions.append(pieces.position)
        vertex[here] = first + pieces.vertex
        ends.append(first + pieces.ends)
        lanes.append(ours[pieces.lane])
        levels.append(np.full(len(pieces.position), level))
    whole = LaneSegments(
        position=np.concatenate(positions), vertex=vertex, ends=np.concatenate(ends), lane=np.concatenate(lanes)
    )
    return whole, np.concatenate(levels)


def _clear(world: World, level: Int, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether discs moving from `start` to `end` f8[k,2] on `level` i8[k] clear solids and open doors."""
    clear = np.ones(len(start), bool)
    for index in np.unique(level):
        here = level == index
        clear[here] = has_clearance(world.levels[index], start[here], end[here], radius)
        clear[here] &= clears_open_doors(world, int(index), start[here], end[here], radius)
    return clear


def _ticks(world: World, pieces: LaneSegments, level: Int, robot: RobotModel, tick: float) -> Int:
    """Return the duration i8[m] of each segment for one robot model; -1 where it would touch something solid."""
    start, end = pieces.position[pieces.ends[:, 0]], pieces.position[pieces.ends[:, 1]]
    limit = np.array([lane.speed_limit or np.inf for lane in world.lanes])[pieces.lane]
    length = np.hypot(*(end - start).T)
    ticks = driving_ticks(length, np.minimum(limit, robot.max_speed), tick)
    clear = _clear(world, level[pieces.ends[:, 0]], start, end, robot.radius)
    return np.where(clear, ticks, -1)


def _directed(pieces: LaneSegments, lanes: tuple[Lane, ...], duration: Int, drivable: Bool) -> tuple[Int, Int]:
    """Return edges i8[E,2] sorted by start, two per two-way segment, and durations; the fastest of parallel edges."""
    both = np.array([lane.bidirectional for lane in lanes])[pieces.lane] & drivable
    edges = np.concatenate([pieces.ends[drivable], pieces.ends[both][:, ::-1]])
    duration = np.concatenate([duration[:, drivable], duration[:, both]], axis=1)
    slow = np.where(duration < 0, np.iinfo(np.int64).max, duration)
    unique, group = np.unique(edges, axis=0, return_inverse=True)
    fastest = np.full((len(duration), len(unique)), np.iinfo(np.int64).max)
    for row, ticks in zip(fastest, slow, strict=True):
        np.minimum.at(row, group.ravel(), ticks)
    return unique, np.where(fastest == np.iinfo(np.int64).max, -1, fastest)


def _lanes_of(world: World, robot: RobotModel) -> Bool:
    """Tell bool[lanes] which lanes belong to the navigation graph that a robot is bound to.

    Raises:
        InputError: the world has no lane of that graph.
    """
    graph = np.array([lane.graph for lane in world.lanes])
    if robot.graph is None:
        return np.ones(len(graph), bool)
    if robot.graph not in graph:
        known = ", ".join(map(str, np.unique(graph)))
        raise InputError(f"fleet: world {world.name!r} has no lane of graph {robot.graph}", hint=f"graphs: {known}")
    lanes: Bool = graph == robot.graph
    return lanes


def _notes(world: World, pieces: LaneSegments, drivable: Bool, offered: Bool) -> list[str]:
    notes = []
    cut = int((np.bincount(pieces.lane, minlength=1) > 1).sum())
    if cut:
        made = len(pieces.position) - len(np.unique(pieces.vertex))
        notes.append(f"{cut} lanes are cut where they meet others; {made} junctions without a vertex got one.")
    unused = len(np.unique(pieces.lane[~offered]))
    if unused:
        notes.append(f"{unused} lanes of navigation graphs without robots are left out.")
    for index in np.unique(pieces.lane[~drivable & offered]):
        lane = world.lanes[index]
        ends = " – ".join(called(world, vertex) for vertex in (lane.start, lane.end))
        notes.append(f"Lane {ends} is left out where a robot on it would touch something solid.")
    return notes


def _mutexes(world: World, pieces: LaneSegments, number: Int, edges: Int) -> tuple[Resource, ...]:
    """Return a resource for each mutex. A robot keeps it at a vertex between two of its lanes and no others."""
    names = [lane.mutex for lane in world.lanes]
    named = [str(vertex.parameters.get("mutex", "")) for vertex in world.vertices]
    mutexes = []
    for name in sorted({*names, *named} - {""}):
        drawn = number[pieces.ends[np.array([names[lane] == name for lane in pieces.lane], bool)]]
        pairs = {tuple(pair) for ends in drawn.tolist() for pair in (ends, ends[::-1])}
        in_group = np.array([tuple(edge) in pairs for edge in edges.tolist()], bool)
        vertices = {int(number[pieces.vertex[index]]) for index, mutex in enumerate(named) if mutex == name} - {-1}
        for vertex in np.unique(edges[in_group]).tolist():
            touching = (edges == vertex).any(axis=1)
            if in_group[touching].all() and len(np.unique(edges[touching])) > 2:
                vertices.add(vertex)
        if in_group.any() or vertices:
            mutex = Resource(
                name=name,
                kind="mutex",
                vertices=tuple(sorted(vertices)),
                edges=tuple(np.flatnonzero(in_group).tolist()),
            )
            mutexes.append(mutex)
    return tuple(mutexes)


def _lost(world: World, lost: Bool) -> list[str]:
    names = [called(world, int(index)) for index in np.flatnonzero(lost)]
    return [f"No robot can stand at {', '.join(names)}."] if names else []
