"""Motion in steps (2023, 2024): walls, two robots in a cell, swaps."""

import numpy as np

from mrpbench_core.files.text import counted
from mrpbench_core.model.common.arrays import Byte, Int, Int32
from mrpbench_league.files.motion import CLOCKWISE, COUNTER_CLOCKWISE, FORWARD
from mrpbench_league.files.output import LorrOutput
from mrpbench_league.files.problem import LorrProblem
from mrpbench_league.scoring.faults import Faults

OFFSETS = np.array([[0, 1], [1, 0], [0, -1], [-1, 0]])
"""Row and column of one cell ahead, by heading."""


def cells_by_step(problem: LorrProblem, output: LorrOutput, faults: Faults) -> Int32:
    """Return the cell of each robot at each time, i4[T+1,n]; a move that leaves the map or enters a wall counts as made
    up to the edge of the map.
    """
    letters = _letters(output, faults)
    shape = np.array(problem.blocked.shape)
    place, heading = output.start[:, :2].astype(np.int64), output.start[:, 2]
    cells = np.empty((len(letters) + 1, len(place)), np.int32)
    cells[0] = place @ (shape[1], 1)
    _check_cells(problem, cells[0], 0, faults)
    for step, row in enumerate(letters):
        place = place + OFFSETS[heading] * (row == FORWARD)[:, None]
        for robot in np.flatnonzero(((place < 0) | (place >= shape)).any(axis=1)):
            faults.add(step + 1, f"robot {robot} leaves the map")
        place = np.clip(place, 0, shape - 1)
        heading = (heading + (row == CLOCKWISE) - (row == COUNTER_CLOCKWISE)) % 4
        cells[step + 1] = place @ (shape[1], 1)
        _check_cells(problem, cells[step + 1], step + 1, faults)
        _check_swaps(cells[step].astype(np.int64), cells[step + 1].astype(np.int64), step + 1, faults)
    return cells


def _letters(output: LorrOutput, faults: Faults) -> Byte:
    """The action of each robot in each step, u1[T,n]; what is missing is a wait."""
    lengths = [len(one.letters) for one in output.motion]
    wrong = [robot for robot, length in enumerate(lengths) if length != output.makespan]
    if wrong:
        steps = counted(lengths[wrong[0]], "step")
        more = f"; {counted(len(wrong) - 1, 'more robot')} differ" if len(wrong) > 1 else ""
        faults.add(-1, f"actualPaths: robot {wrong[0]} has {steps}, which is not the makespan {output.makespan}{more}")
    table = np.full((max(lengths), len(output.motion)), ord("W"), np.uint8)
    for robot, one in enumerate(output.motion):
        table[: len(one.letters), robot] = one.letters
    return table


def _check_cells(problem: LorrProblem, cells: Int32, time: int, faults: Faults) -> None:
    for robot in np.flatnonzero(problem.blocked.ravel()[cells]).tolist():
        faults.add(time, f"robot {robot} is in the wall at cell {cells[robot]}")
    ordered = np.sort(cells)
    if not (ordered[1:] == ordered[:-1]).any():
        return
    order = np.argsort(cells, kind="stable")
    for at in np.flatnonzero(cells[order][1:] == cells[order][:-1]).tolist():
        first, second = order[at : at + 2].tolist()
        faults.add(time, f"vertex conflict: robots {first} and {second} are in cell {cells[first]}")


def _check_swaps(before: Int, after: Int, time: int, faults: Faults) -> None:
    moving = np.flatnonzero(before != after)
    span = int(max(before.max(initial=0), after.max(initial=0))) + 1
    edges = before[moving] * span + after[moving]
    back = after[moving] * span + before[moving]
    swapping = np.flatnonzero(np.isin(edges, back))
    robot_on = {int(edges[i]): int(moving[i]) for i in swapping}
    for i in swapping:
        first, second = int(moving[i]), robot_on[int(back[i])]
        if first < second:
            faults.add(time, f"edge conflict: robots {first} and {second} swap their cells")
