"""Removes edges from roadmaps on which an open door leaf would block the robot that opened the door.

A robot keeps a door open until it has left the area that the leaves sweep. If an open leaf blocks its way out of that
area, the robot waits forever: the leaf cannot close because the robot is in its way. Therefore no route leads from a
doorway to an edge that the open leaf blocks. Either those edges are removed or, if that separates more places, the
edges through the doorway.
"""

import numpy as np

from mrpbench_core.builtin.roadmaps.proximity import MARGIN, elements_near, select_edges
from mrpbench_core.checking.clearance import touches
from mrpbench_core.checking.components import components
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.doors import leaf_segments, swept_areas
from mrpbench_core.model.worlds.facilities import Facilities, OperatedDoor
from mrpbench_core.model.worlds.solids import wall_boxes
from mrpbench_core.model.worlds.world import Door, World


def clears_open_doors(world: World, level: int, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether discs that move from `start` to `end` f8[k,2] through doors clear the open leaves."""
    clear = np.ones(len(start), bool)
    for door in world.levels[level].doors:
        passing = touches(np.array([door.start, door.end]), start, end, radius)
        for box in _open_leaves(door):
            clear &= ~(passing & touches(box, start, end, radius))
    return clear


def avoid_open_doors(roadmap: Roadmap, world: World, radius: float) -> tuple[Roadmap, list[str]]:
    """Return the roadmap without edges that lead a robot to an open leaf that blocks it, and what was left out."""
    notes = []
    for operated in Facilities(world).doors:
        if operated.lift is None:
            through, blocked = _blocked(operated, roadmap, radius)
            if len(blocked):
                without = [np.delete(np.arange(len(roadmap.edges)), out) for out in (blocked, through)]
                pairs = [_pairs(roadmap, edges) for edges in without]
                closed = pairs[1] > pairs[0]
                notes.append(_note(operated, roadmap, blocked, closed=closed))
                roadmap = select_edges(roadmap, without[closed])
    return roadmap, notes


def _open_leaves(door: Door) -> list[Float]:
    return list(wall_boxes(leaf_segments(door, 1.0), door.thickness).reshape(-1, 4, 4)[:, :, :2])


def _blocked(operated: OperatedDoor, roadmap: Roadmap, radius: float) -> tuple[Int, Int]:
    """Return the edges through a doorway, and the blocked ones that a robot could reach before the door closes."""
    doorway = np.array([operated.door.start, operated.door.end])
    _, through = elements_near([doorway], roadmap, operated.levels, radius)
    _, blocked = elements_near(_open_leaves(operated.door), roadmap, operated.levels, radius)
    blocked = np.setdiff1d(blocked, through)
    if not len(through) or not len(blocked):
        return through, blocked[:0]
    stands, drives = elements_near([doorway, *swept_areas(operated.door)], roadmap, operated.levels, radius + MARGIN)
    # A robot holds the door while it is on these edges, which are joined by the vertices among them.
    count = len(roadmap.position)
    edge, end = np.repeat(drives, 2), roadmap.edges[drives].ravel()
    stands_there = np.isin(end, stands)
    label = components(count + len(roadmap.edges), np.stack([count + edge[stands_there], end[stands_there]], axis=1))
    return through, blocked[np.isin(label[count + blocked], label[count + through])]


def _pairs(roadmap: Roadmap, edges: Int) -> int:
    """Count the connected pairs of places (without places: of vertices) on the edges `kept`."""
    label = components(len(roadmap.position), roadmap.edges[edges])
    if (roadmap.place >= 0).any():
        label = label[np.unique(roadmap.place[roadmap.place >= 0])]
    _, sizes = np.unique(label, return_counts=True)
    return int((sizes**2).sum())


def _note(operated: OperatedDoor, roadmap: Roadmap, blocked: Int, *, closed: bool) -> str:
    ends = np.unique(np.sort(roadmap.edges[blocked], axis=1), axis=0)
    x, y = roadmap.position[ends[0]].mean(axis=0)
    there = f"at ({x:.2f}, {y:.2f})"
    if closed:
        return f"Door {operated.name} stays closed: its open leaf would block a robot that passes through it, {there}."
    count = "1 edge is" if len(ends) == 1 else f"{len(ends)} edges are"
    return f"Door {operated.name}: {count} left out, {there}, where the open leaf would block a robot."
