"""Where a fleet is: its world, its roadmap by names and positions, and the ways on it."""

import heapq
from collections import defaultdict

import numpy as np

from mrpbench_core.api import Fleet, Roadmap, World
from mrpbench_live.fleet.regions import clearance

REACH = 0.5
"""Metres from a vertex of the roadmap within which a position means this vertex; on a raster, its cell."""

FARTHEST = 1e6
"""Metres from the origin beyond which there is no vertex, whatever a message says."""


def level_names(world: World) -> list[str]:
    """Return the name of each level, as protocols call it."""
    return [level.name or f"level_{index}" for index, level in enumerate(world.levels)]


class Site:
    """A roadmap as protocols see it.

    Args:
        world: gives the names of levels and places.
        roadmap: of the run.
        fleet: of the run.
    """

    def __init__(self, world: World, roadmap: Roadmap, fleet: Fleet) -> None:
        self.world, self.roadmap, self.fleet = world, roadmap, fleet
        self.robots, self.profiles = fleet.names, fleet.profiles[1]
        """The name and the motion profile of each robot."""
        self.levels = level_names(world)
        """The name of each level."""
        self.level_of = {name: index for index, name in enumerate(self.levels)}
        names = {f"v{vertex}": vertex for vertex in range(len(roadmap.position))}
        named = zip(world.vertices, roadmap.place.tolist(), strict=False)
        names |= {place.name: vertex for place, vertex in named if place.name and vertex >= 0}
        self.vertex_of = names
        """Vertices by name: those of the world, and `v12` for vertex 12."""
        self.name_of = {vertex: name for name, vertex in names.items()}
        self.has_headings = not bool(np.isnan(roadmap.heading).all())
        """Vertices prescribe yaws."""
        cells = [] if roadmap.grid is None else roadmap.grid.cell.tolist()
        self._cells = {(row, column): vertex for vertex, (row, column) in reversed(list(enumerate(cells)))}
        """On a raster, the first vertex of each cell."""
        self._guarded = {
            edge
            for resource in roadmap.resources
            if resource.kind != "mutex"
            for edge in (*resource.edges, *_edges_at(roadmap, resource.vertices))
        }
        self._leaving: list[dict[int, list[tuple[int, int, int]]]] = [
            self._edges_of(profile) for profile in range(len(roadmap.duration))
        ]
        self._ways: dict[tuple[int, int, int, bool, frozenset[int]], tuple[int, ...] | None] = {}
        self._entering: dict[tuple[int, tuple[tuple[float, float], ...], float], frozenset[int]] = {}

    def nearest(self, x: float, y: float, level: int) -> int | None:
        """Return the vertex that a position (metres) on a level means, or None if there is none there."""
        if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST):
            return None
        if (grid := self.roadmap.grid) is not None:
            column, row = np.floor((np.array([x, y]) - grid.origin) / grid.cell_size).astype(int).tolist()
            return self._cells.get((row, column)) if level == self.roadmap.level[0] else None
        found, distance = self.roadmap.nearest(x, y, level)
        return found if distance <= REACH else None

    def facing(self, vertex: int, yaw: float) -> int:
        """Return the vertex at the place of another whose heading is nearest to a yaw (radians)."""
        return int(self.roadmap.facing(np.array([vertex], np.int32), np.array([yaw]))[0])

    def way(
        self, profile: int, start: int, end: int, any_heading: bool = True, closed: frozenset[int] = frozenset()
    ) -> tuple[int, ...] | None:
        """Return the edges of the fastest way from one vertex to another, or None if there is none.

        The vehicle drives it alone: no way leads through a door or a lift, which somebody would have to operate.

        Args:
            profile: motion profile of the robot.
            start: vertex.
            end: vertex.
            any_heading: any vertex at the place of `end` will do.
            closed: edges by which no way leads.
        """
        key = profile, start, end, any_heading and self.has_headings, closed
        if key not in self._ways:
            self._ways[key] = self._search(*key)
        return self._ways[key]

    def entering(self, level: int, polygon: tuple[tuple[float, float], ...], radius: float) -> frozenset[int]:
        """Return the edges by which a disc comes into a polygon (metres) on a level from outside."""
        key = level, polygon, radius
        if key not in self._entering:
            tail, head = self.roadmap.edges.reshape(-1, 2).T
            position, corners = self.roadmap.position, np.array(polygon)
            low, high = corners.min(axis=0) - radius, corners.max(axis=0) + radius
            begin, end = position[tail], position[head]
            near = (np.maximum(begin, end) >= low).all(axis=1) & (np.minimum(begin, end) <= high).all(axis=1)
            found = np.flatnonzero(near & (self.roadmap.level[tail] == level))
            begin, end = begin[found], end[found]
            comes = clearance(begin, end, corners) < radius
            outside = clearance(begin, begin, corners) >= radius
            self._entering[key] = frozenset(found[comes & outside].tolist())
        return self._entering[key]

    def _search(
        self, profile: int, start: int, end: int, any_heading: bool, closed: frozenset[int]
    ) -> tuple[int, ...] | None:
        position, level, ends = self.roadmap.position, self.roadmap.level, {end}
        if any_heading:
            same = (position == position[end]).all(axis=1) & (level == level[end])
            ends = set(np.flatnonzero(same).tolist())
        leaving = self._leaving[profile]
        best, by = {start: 0}, {start: -1}
        open_vertices = [(0, start)]
        while open_vertices:
            spent, vertex = heapq.heappop(open_vertices)
            if vertex in ends:
                return self._back(by, vertex)
            if spent > best[vertex]:
                continue
            for edge, head, ticks in leaving[vertex]:
                if spent + ticks < best.get(head, 2**60) and edge not in closed:
                    best[head], by[head] = spent + ticks, edge
                    heapq.heappush(open_vertices, (spent + ticks, head))
        return None

    def _back(self, by: dict[int, int], vertex: int) -> tuple[int, ...]:
        edges: list[int] = []
        while (edge := by[vertex]) >= 0:
            edges.append(edge)
            vertex = int(self.roadmap.edges[edge, 0])
        return tuple(reversed(edges))

    def _edges_of(self, profile: int) -> dict[int, list[tuple[int, int, int]]]:
        leaving: dict[int, list[tuple[int, int, int]]] = defaultdict(list)
        ticks = self.roadmap.duration[profile].tolist()
        for edge, (tail, head) in enumerate(self.roadmap.edges.tolist()):
            if ticks[edge] >= 0 and edge not in self._guarded:
                leaving[tail].append((edge, head, ticks[edge]))
        return leaving


def _edges_at(roadmap: Roadmap, vertices: tuple[int, ...]) -> list[int]:
    """The edges that begin or end at some vertices."""
    return np.flatnonzero(np.isin(roadmap.edges, vertices).any(axis=1)).tolist() if vertices else []
