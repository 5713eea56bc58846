"""Roadmaps lead round open doors, which would bar the way of whoever came through them.

A robot keeps a door open until it is out of what the leaves sweep. Where on the way an open leaf stands before it, it
would wait for ever for a leaf that cannot shut as the robot is in its way. So no way leads from a doorway to where the
open leaf stands: either the edges through the leaf are left out or, where that would part more, those through the door.
"""

import numpy as np

from mrpbench_core.builtin.roadmaps.proximity import MARGIN, elements_near, select_edges
from mrpbench_core.checking.clearance import touches
from mrpbench_core.checking.components import components
from mrpbench_core.model.arrays import Bool, Float, Int
from mrpbench_core.model.doors import leaf_segments, swept_areas
from mrpbench_core.model.facilities import Facilities, OperatedDoor
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.solids import wall_boxes
from mrpbench_core.model.world import Door, World


def clears_open_doors(world: World, level: int, start: Float, end: Float, radius: float) -> Bool:
    """Tell bool[k] whether a disc that moves from `start` to `end` f8[k,2] through doors touches no open leaf."""
    clear = np.ones(len(start), bool)
    for door in world.levels[level].doors:
        passing = touches(np.array([door.start, door.end]), start, end, radius)
        for box in _open_leaves(door):
            clear &= ~(passing & touches(box, start, end, radius))
    return clear


def avoid_open_doors(roadmap: Roadmap, world: World, radius: float) -> tuple[Roadmap, list[str]]:
    """The roadmap without edges by which an open leaf would come to bar a robot, and what was left out."""
    notes = []
    for operated in Facilities(world).doors:
        if operated.lift is None:
            through, barred = _barred(operated, roadmap, radius)
            if len(barred):
                without = [np.delete(np.arange(len(roadmap.edges)), out) for out in (barred, through)]
                pairs = [_pairs(roadmap, kept) for kept in without]
                shut = pairs[1] > pairs[0]
                notes.append(_note(operated, roadmap, barred, shut=shut))
                roadmap = select_edges(roadmap, without[shut])
    return roadmap, notes


def _open_leaves(door: Door) -> list[Float]:
    return list(wall_boxes(leaf_segments(door, 1.0), door.thickness).reshape(-1, 4, 4)[:, :, :2])


def _barred(operated: OperatedDoor, roadmap: Roadmap, radius: float) -> tuple[Int, Int]:
    """The edges through a doorway, and those an open leaf bars that a robot could drive on before the door shuts."""
    doorway = np.array([operated.door.start, operated.door.end])
    _, through = elements_near([doorway], roadmap, operated.levels, radius)
    _, barred = elements_near(_open_leaves(operated.door), roadmap, operated.levels, radius)
    barred = np.setdiff1d(barred, through)
    if not len(through) or not len(barred):
        return through, barred[:0]
    stands, drives = elements_near([doorway, *swept_areas(operated.door)], roadmap, operated.levels, radius + MARGIN)
    # A robot keeps the door as long as it is on these: edges, linked by the vertices among them.
    count = len(roadmap.position)
    edge, end = np.repeat(drives, 2), roadmap.edges[drives].ravel()
    kept = np.isin(end, stands)
    label = components(count + len(roadmap.edges), np.stack([count + edge[kept], end[kept]], axis=1))
    return through, barred[np.isin(label[count + barred], label[count + through])]


def _pairs(roadmap: Roadmap, kept: Int) -> int:
    """How many pairs of places (without places: of vertices) some way joins, on the edges `kept`."""
    label = components(len(roadmap.position), roadmap.edges[kept])
    if (roadmap.place >= 0).any():
        label = label[np.unique(roadmap.place[roadmap.place >= 0])]
    _, sizes = np.unique(label, return_counts=True)
    return int((sizes**2).sum())


def _note(operated: OperatedDoor, roadmap: Roadmap, barred: Int, *, shut: bool) -> str:
    ends = np.unique(np.sort(roadmap.edges[barred], axis=1), axis=0)
    x, y = roadmap.position[ends[0]].mean(axis=0)
    there = f"at ({x:.2f}, {y:.2f})"
    if shut:
        return f"Door {operated.name} stays shut: open, it would bar the way of who comes through, {there}."
    count = "1 way is" if len(ends) == 1 else f"{len(ends)} ways are"
    return f"Door {operated.name}: {count} left out, {there}, where the open leaf would bar who comes through."
