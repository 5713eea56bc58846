"""The path of one vehicle on the roadmap, and where the nodes of its order are on it."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mrpbench_core.api import Float
from mrpbench_live.fleet.paths import FleetPaths
from mrpbench_live.fleet.site import Site
from mrpbench_live.vda5050.orders import Node, asks_for_heading
from mrpbench_live.vda5050.zones import ZoneSets


class Track:
    """Turns nodes of orders into a path.

    Args:
        site: of the fleet.
        paths: of all robots.
        robot: of this vehicle.
    """

    def __init__(self, site: Site, paths: FleetPaths, robot: int) -> None:
        self._site, self._paths, self._robot = site, paths, robot
        self._profile = site.profiles[robot]
        self.footprint: Float = site.fleet.robots[robot].footprint
        """f8[k,2] of the vehicle, metres."""
        self.zones = ZoneSets(site, robot)

    @property
    def maps(self) -> Sequence[str]:
        """The maps that exist: the levels of the world."""
        return self._site.levels

    def locate(self, node: Mapping[str, Any]) -> tuple[int, tuple[float, float]] | None:
        """Return vertex and position (metres) of a node, by its position or else by its name; None: there is none."""
        position = node.get("nodePosition")
        if position is None:
            vertex = self._site.vertex_of.get(node["nodeId"])
            return None if vertex is None else (vertex, self._place(vertex))
        x, y = float(position["x"]), float(position["y"])
        found = self._site.nearest(x, y, self._site.level_of[position["mapId"]])
        if found is not None and asks_for_heading(position):
            found = self._site.facing(found, float(position["theta"]))
        return None if found is None else (found, (x, y))

    @property
    def has_headings(self) -> bool:
        """True if the vehicle can take the orientation that a node asks for."""
        return self._site.has_headings

    def continue_by(self, start: int, nodes: Sequence[Node]) -> list[tuple[int, ...]] | Node:
        """Return the ways from one vertex to each of the nodes in turn, or the first node to which there is none."""
        ways = []
        for node in nodes:
            way = self._site.way(self._profile, start, node.vertex, node.any_heading, self.zones.closed)
            if way is None:
                return node
            start = int(self._site.roadmap.edges[way[-1], 1]) if way else start
            ways.append(way)
        return ways

    def replace(self, moves: int, nodes: Sequence[Node], ways: Sequence[tuple[int, ...]]) -> None:
        """Continue the path after some moves by ways, and note where the nodes at their ends are.

        What the path has in common with the one before stays, so that no new plan is needed for it.
        """
        mark = moves
        for node, way in zip(nodes, ways, strict=True):
            mark += len(way)
            node.mark = mark
        new = [edge for way in ways for edge in way]
        old = self._paths.after(self._robot, moves)
        same = next((at for at, (one, other) in enumerate(zip(old, new, strict=False)) if one != other), None)
        same = min(len(old), len(new)) if same is None else same
        self._paths.shorten(self._robot, moves + same)
        self._paths.append(self._robot, tuple(new[same:]))

    def line(self, way: Sequence[int]) -> Float:
        """Return the places f8[k,2] (metres) along some edges, without those that follow upon themselves."""
        if not way:
            return np.empty((0, 2))
        ends = self._site.roadmap.edges[list(way)]
        found: Float = self._site.roadmap.position[[ends[0, 0], *ends[:, 1]]]
        moves = np.concatenate([[True], (np.diff(found, axis=0) != 0).any(axis=1)])
        line: Float = found[moves]
        return line

    @property
    def ahead(self) -> Float:
        """f8[k,2] metres: the places at which the moves end that the vehicle has not made."""
        way = self._paths.after(self._robot, self.passed)
        found: Float = self._site.roadmap.position[self._site.roadmap.edges[way, 1]] if way else np.empty((0, 2))
        return found

    @property
    def barrier(self) -> int | None:
        """The moves before the first one that is not released and enters a BLOCKED zone; None: there is none."""
        closed, released = self.zones.closed, self.released
        way = self._paths.after(self._robot, released) if closed else ()
        return next((released + at for at, edge in enumerate(way) if edge in closed), None)

    def shorten(self, moves: int) -> int:
        """Take back what is not released after some moves; return the moves that are left."""
        return self._paths.shorten(self._robot, moves)

    def end_after(self, moves: int) -> int:
        """Return the vertex at which the path ends if it is shortened to some moves that are not taken back."""
        ahead = self._paths.after(self._robot, moves)
        return int(self._site.roadmap.edges[ahead[0], 0]) if ahead else self._paths.end(self._robot)

    def allow(self, moves: int, speed: float) -> None:
        """Let the vehicle drive until it has made so many moves, at most so fast (m/s)."""
        self._paths.allowed[self._robot] = moves
        self._paths.speed[self._robot] = speed

    @property
    def passed(self) -> int:
        """Moves that the vehicle has made."""
        return int(self._paths.passed[self._robot])

    @property
    def released(self) -> int:
        """Moves that cannot be taken back."""
        return int(self._paths.released[self._robot])

    @property
    def length(self) -> int:
        """Moves of the whole path."""
        return int(self._paths.length[self._robot])

    @property
    def end(self) -> int:
        """The vertex at which the path ends."""
        return self._paths.end(self._robot)

    def name(self, vertex: int) -> str:
        """Return the name of a vertex."""
        return self._site.name_of[vertex]

    def _place(self, vertex: int) -> tuple[float, float]:
        x, y = self._site.roadmap.position[vertex].tolist()
        return x, y


def distance(here: Sequence[float], there: tuple[float, float]) -> float:
    """Return the metres between a pose and a position."""
    return float(np.hypot(here[0] - there[0], here[1] - there[1]))
