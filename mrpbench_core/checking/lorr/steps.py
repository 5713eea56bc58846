"""Motion in steps (2023, 2024): walls, two robots in a cell, swaps."""

import numpy as np

from mrpbench_core.checking.lorr.faults import Faults
from mrpbench_core.files.lorr.motion import CLOCKWISE, COUNTER_CLOCKWISE, FORWARD
from mrpbench_core.files.lorr.output import LorrOutput
from mrpbench_core.files.lorr.problem import LorrProblem
from mrpbench_core.model.common.arrays import Byte, Int

OFFSETS = np.array([[0, 1], [1, 0], [0, -1], [-1, 0]])
"""Row and column of one cell ahead, by heading."""


def cells_by_step(problem: LorrProblem, output: LorrOutput, faults: Faults) -> Int:
    """Return the cell of each robot at each time, i8[T+1,n]; a move that leaves the map or enters a wall counts as made
    up to the edge of the map.
    """
    letters = _letters(output, faults)
    turns = (letters == CLOCKWISE).astype(np.int8) - (letters == COUNTER_CLOCKWISE)
    heading = np.zeros((len(letters) + 1, letters.shape[1]), np.int8)
    heading[0] = output.start[:, 2]
    heading[1:] = (heading[0] + np.cumsum(turns, axis=0)) % 4
    shape = np.array(problem.blocked.shape)
    place = np.zeros((*heading.shape, 2), np.int32)
    place[0] = output.start[:, :2]
    for step, row in enumerate(letters):
        after = place[step] + OFFSETS[heading[step]] * (row == FORWARD)[:, None]
        for robot in np.flatnonzero(((after < 0) | (after >= shape)).any(axis=1)):
            faults.add(step + 1, f"robot {robot} leaves the map")
        place[step + 1] = np.clip(after, 0, shape - 1)
    cells: Int = place[..., 0].astype(np.int64) * shape[1] + place[..., 1]
    _check_cells(problem, cells, faults)
    return cells


def _letters(output: LorrOutput, faults: Faults) -> Byte:
    """The action of each robot in each step, u1[T,n]; what is missing is a wait."""
    lengths = {len(one.letters) for one in output.motion}
    if lengths != {output.makespan}:
        shortest, longest = min(lengths), max(lengths)
        faults.add(-1, f"actualPaths hold {shortest} to {longest} steps, the makespan is {output.makespan}")
    table = np.full((max(lengths), len(output.motion)), ord("W"), np.uint8)
    for robot, one in enumerate(output.motion):
        table[: len(one.letters), robot] = one.letters
    return table


def _check_cells(problem: LorrProblem, cells: Int, faults: Faults) -> None:
    blocked = problem.blocked.ravel()
    for step, robot in np.argwhere(blocked[cells]).tolist():
        faults.add(step, f"robot {robot} is in the wall at cell {cells[step, robot]}")
    ordered = np.sort(cells, axis=1)
    for step in np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(axis=1)).tolist():
        for first, second in _sharing(cells[step]):
            faults.add(step, f"vertex conflict: robots {first} and {second} are in cell {cells[step, first]}")
    width = blocked.size
    for step in range(len(cells) - 1):
        moving = np.flatnonzero(cells[step] != cells[step + 1])
        edges = cells[step, moving] * width + cells[step + 1, moving]
        back = cells[step + 1, moving] * width + cells[step, moving]
        swapping = np.flatnonzero(np.isin(edges, back))
        found = {int(edges[i]): int(moving[i]) for i in swapping}
        for i in swapping:
            first, second = int(moving[i]), found[int(back[i])]
            if first < second:
                faults.add(step + 1, f"edge conflict: robots {first} and {second} swap their cells")


def _sharing(cells: Int) -> list[tuple[int, int]]:
    order = np.argsort(cells, kind="stable")
    same = np.flatnonzero(cells[order][1:] == cells[order][:-1])
    return [(int(order[i]), int(order[i + 1])) for i in same]
