"""Between roadmaps that are rasters and maps of cells: vertices become places, traces become paths."""

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
    """i8[V]: the place of each vertex."""
    vertex: Int32
    """i4[size]: the vertex at each place, -1 = none."""
    edge: Int32
    """i4[V,5]: the edge of each action at each vertex, -1 = none."""


def board_of(roadmap: Roadmap, margin: int) -> Board | str:
    """Return the cells of a roadmap, or why it has none that robots walk step by step.

    Robots move between all neighbouring cells, in one tick.
    """
    grid, heading = roadmap.grid, roadmap.heading
    if grid is None:
        return "needs a roadmap whose vertices are cells: `roadmap: grid`"
    if not np.isnan(heading).all():
        return "needs a roadmap without headings"
    if (roadmap.duration != 1).any():
        return "needs a roadmap on which every move takes one tick"
    rows, columns = grid.shape
    blocked = np.ones((1, rows, columns), bool)
    cell = np.column_stack([rows - 1 - grid.cell[:, 0], grid.cell[:, 1]]).astype(np.int64)
    blocked[0, cell[:, 0], cell[:, 1]] = False
    maps = Maps(blocked, margin)
    place = maps.places(cell[None])[0]
    vertex = np.full(maps.size, -1, np.int32)
    vertex[place] = np.arange(len(place))
    edge = np.full((len(place), 5), -1, np.int32)
    step = place[roadmap.edges[:, 1]] - place[roadmap.edges[:, 0]] if len(roadmap.edges) else np.zeros(0, np.int64)
    for action in range(1, 5):
        leads = np.flatnonzero(step == maps.offset[action])
        edge[roadmap.edges[leads, 0], action] = leads
        neighbour = vertex[place + maps.offset[action]]
        if ((neighbour >= 0) & (edge[:, action] < 0)).any():
            return "needs a roadmap with an edge between any two neighbouring cells"
    return Board(maps=maps, place=place, vertex=vertex, edge=edge)


def paths_of(board: Board, trace: Int) -> Paths:
    """Return the paths of robots that were at places i8[T+1,n], one step after another.

    Waits in a row are one segment, and waits at the end are left out.
    """
    steps, robots = trace.shape[0] - 1, trace.shape[1]
    at, offset = trace[:-1].T, (trace[1:] - trace[:-1]).T
    order = np.argsort(board.maps.offset)
    action = order[np.searchsorted(board.maps.offset[order], offset)]
    edge = board.edge[board.vertex[at], action]
    moves = edge >= 0
    last = (moves * np.arange(1, steps + 1)).max(axis=1, initial=0)  # steps until the last move has ended
    begins = moves | np.pad(moves, ((0, 0), (1, 0)), constant_values=True)[:, :-1]
    begins &= np.arange(steps) < last[:, None]
    robot, enter = np.nonzero(begins)
    leave = np.append(enter[1:], 0)
    ends = np.append(robot[1:] != robot[:-1], True) if len(robot) else np.zeros(0, bool)
    leave = np.where(ends, last[robot], leave[: len(robot)])
    return Paths(first=np.searchsorted(robot, np.arange(robots + 1)), edge=edge[robot, enter], enter=enter, leave=leave)
