"""Between roadmaps that are rasters and maps of cells: vertices become places, traces become paths."""

from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.api import Int, Int32, Paths, Roadmap
from mrpbench_policies.maps import Maps


@attrs.frozen(kw_only=True, eq=False)
class Board:
    """The cells of a roadmap, with row 0 on top (its greatest y)."""

    maps: Maps
    """Of one environment."""
    place: Int
    """i8[V]: the place of each vertex; with headings, several have the same one."""
    vertex: Int32
    """i4[size]: the first vertex at each place, -1 = none."""
    edges: Int32
    """i4[E,2] of the roadmap."""
    leads: Int32
    """i4[size,5]: the edge of each action at each place, -1 = none."""
    turns: Mapping[tuple[int, int], int]
    """The edge from vertex to vertex at one place."""
    is_unit: bool
    """Every move takes one tick, and turning none."""


def board_of(roadmap: Roadmap, margin: int) -> Board | str:
    """Return the cells of a roadmap, or why it has none on which robots move between all neighbouring ones."""
    grid = roadmap.grid
    if grid is None:
        return "needs a roadmap whose vertices are cells: `roadmap: grid`"
    if (roadmap.duration < 0).any():
        return "needs a roadmap all of whose edges every robot may use"
    rows, columns = grid.shape
    blocked = np.ones((1, rows, columns), bool)
    cell = np.column_stack([rows - 1 - grid.cell[:, 0], grid.cell[:, 1]]).astype(np.int64)
    blocked[0, cell[:, 0], cell[:, 1]] = False
    maps = Maps(blocked, margin)
    place = maps.places(cell[None])[0]
    vertex = np.full(maps.size, -1, np.int32)
    vertex[place[::-1]] = np.arange(len(place))[::-1]  # of equal places the last one counts, which is the first vertex
    leads = np.full((maps.size, 5), -1, np.int32)
    ends = place[roadmap.edges.reshape(-1, 2)]
    step = ends[:, 1] - ends[:, 0]
    for action in range(1, 5):
        (edges,) = (step == maps.offset[action]).nonzero()
        leads[ends[edges, 0], action] = edges
        if ((vertex[place + maps.offset[action]] >= 0) & (leads[place, action] < 0)).any():
            return "needs a roadmap with an edge between any two neighbouring cells"
    on_the_spot = (step == 0).nonzero()[0].tolist()
    return Board(
        maps=maps,
        place=place,
        vertex=vertex,
        edges=roadmap.edges,
        leads=leads,
        turns={tuple(roadmap.edges[edge].tolist()): edge for edge in on_the_spot},
        is_unit=bool((roadmap.duration == 1).all() and np.isnan(roadmap.heading).all()),
    )


def paths_of(board: Board, trace: Int) -> Paths:
    """Return the paths of robots that were at places i8[T+1,n], one tick after another.

    Waits in a row are one segment, and waits at the end are left out.
    """
    steps, robots = trace.shape[0] - 1, trace.shape[1]
    at, offset = trace[:-1].T, (trace[1:] - trace[:-1]).T
    order = np.argsort(board.maps.offset)
    action = order[np.searchsorted(board.maps.offset[order], offset)]
    edge = board.leads[at, action]
    moves = edge >= 0
    last = (moves * np.arange(1, steps + 1)).max(axis=1, initial=0)  # steps until the last move has ended
    begins = moves | np.pad(moves, ((0, 0), (1, 0)), constant_values=True)[:, :-1]
    begins &= np.arange(steps) < last[:, None]
    robot, enter = np.nonzero(begins)
    leave = np.append(enter[1:], 0)
    ends = np.append(robot[1:] != robot[:-1], True) if len(robot) else np.zeros(0, bool)
    leave = np.where(ends, last[robot], leave[: len(robot)])
    return Paths(first=np.searchsorted(robot, np.arange(robots + 1)), edge=edge[robot, enter], enter=enter, leave=leave)
