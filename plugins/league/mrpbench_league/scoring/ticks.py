"""Motion in ticks (2026): moves of several ticks, squares that must not overlap, delays."""

from typing import NamedTuple

import numpy as np

from mrpbench_core.files.text import counted
from mrpbench_core.model.common.arrays import Byte, Float, Int, Int32
from mrpbench_league.files.motion import CLOCKWISE, COUNTER_CLOCKWISE, FORWARD
from mrpbench_league.files.output import LorrOutput
from mrpbench_league.files.problem import LorrProblem
from mrpbench_league.scoring.faults import Faults
from mrpbench_league.scoring.steps import OFFSETS

TOUCH = 1e-9
"""Overlaps of less than this, in cells, are rounding."""


class Ticked(NamedTuple):
    """Cells at the end of each tick, and when."""

    cells: Int32
    """i4[T+1,n]."""
    time: Int
    """i8[T+1]: the tick of each row; ticks without any answer are left out."""


def cells_by_tick(problem: LorrProblem, output: LorrOutput, faults: Faults) -> Ticked:
    """Return the cells of all robots after each tick of their motion."""
    length = max(len(one.letters) for one in output.motion)
    robots = len(output.motion)
    letters = np.full((length, robots), ord("W"), np.uint8)
    for index, one in enumerate(output.motion):
        letters[: len(one.letters), index] = one.letters
        if len(one.letters) != length:
            ticks = counted(len(one.letters), "tick")
            faults.add(-1, f"actualPaths: robot {index} has {ticks} of motion, others have {length}")
    time = _times(output, length)
    _check_delays(output, letters, time, faults)
    shape = np.array(problem.blocked.shape)
    counter = output.counter
    place, heading = output.start[:, :2].astype(np.int64), output.start[:, 2].astype(np.int64)
    begun, progress = np.zeros(robots, np.uint8), np.zeros(robots, np.int64)
    cells = np.zeros((length + 1, robots), np.int32)
    cells[0] = place @ (shape[1], 1)
    _check_start(problem, cells[0], faults)
    for tick, row in enumerate(letters):
        acting = np.isin(row, (FORWARD, CLOCKWISE, COUNTER_CLOCKWISE))
        for robot in np.flatnonzero(acting & (progress > 0) & (row != begun)).tolist():
            faults.add(int(time[tick + 1]), f"robot {robot} begins {chr(row[robot])} within {chr(begun[robot])}")
            progress[robot] = 0
        begun = np.where(acting, row, begun)
        ahead = OFFSETS[heading]
        translating = ((begun == FORWARD) & (progress + acting > 0))[:, None] * ahead
        target = place + translating
        outside = ((target < 0) | (target >= shape)).any(axis=1)
        inside = np.clip(target, 0, shape - 1)
        bumps = acting & (outside | problem.blocked[inside[:, 0], inside[:, 1]])
        for robot in np.flatnonzero(bumps).tolist():
            faults.add(int(time[tick + 1]), f"robot {robot} drives into a wall")
            begun[robot], progress[robot], acting[robot] = 0, 0, False
            translating[robot], target[robot] = 0, place[robot]
        before = place + translating * (progress / counter)[:, None]
        velocity = translating * (acting / counter)[:, None]
        _check_overlaps(place @ (shape[1], 1), target @ (shape[1], 1), before, velocity, problem, tick, time, faults)
        progress = progress + acting
        done = progress == counter
        place = np.where((done & (begun == FORWARD))[:, None], target, place)
        turn = (begun == CLOCKWISE).astype(np.int64) - (begun == COUNTER_CLOCKWISE)
        heading = np.where(done, (heading + turn) % 4, heading)
        progress = np.where(done, 0, progress)
        cells[tick + 1] = place @ (shape[1], 1)
    return Ticked(cells, time)


def _times(output: LorrOutput, length: int) -> Int:
    """Ticks of the rows of motion. Where ticks are missing, segments say when they begin, else motion ends last."""
    missing = output.makespan - length
    time = np.arange(length + 1) + max(missing, 0)
    if missing <= 0:
        return time
    begins, row = output.motion[0].begins, 0
    stamped = time.copy()
    for begin, ticks in begins:
        stamped[row : row + ticks + 1] = begin + np.arange(ticks + 1)
        row += ticks
    increasing = (np.diff(stamped) > 0).all()
    return stamped if increasing and stamped[0] > 0 and stamped[-1] <= output.makespan else time


def _check_start(problem: LorrProblem, cells: Int32, faults: Faults) -> None:
    for robot in np.flatnonzero(problem.blocked.ravel()[cells]):
        faults.add(0, f"robot {robot} starts in a wall")


def _check_delays(output: LorrOutput, letters: Byte, time: Int, faults: Faults) -> None:
    if output.delays is None:
        return
    for robot, delays in enumerate(output.delays):
        for start, end in delays:
            rows = np.flatnonzero((time[:-1] >= start) & (time[:-1] < end))
            moved = rows[np.isin(letters[rows, robot], (FORWARD, CLOCKWISE, COUNTER_CLOCKWISE))]
            if len(moved):
                faults.add(int(time[moved[0] + 1]), f"robot {robot} acts while it is delayed from {start} to {end}")


def _check_overlaps(
    cell: Int,
    target: Int,
    before: Float,
    velocity: Float,
    problem: LorrProblem,
    tick: int,
    time: Int,
    faults: Faults,
) -> None:
    """A robot's square lies in its cell and, while it moves, in the next: only robots that share one can overlap."""
    moving = np.flatnonzero(target != cell)
    robots = np.concatenate([np.arange(len(cell)), moving])
    held = np.concatenate([cell, target[moving]])
    order = np.argsort(held, kind="stable")
    held, robots = held[order], robots[order]
    pairs: set[tuple[int, int]] = set()
    reach = 1
    while len(same := np.flatnonzero(held[reach:] == held[:-reach])):
        pairs |= {
            (min(a, b), max(a, b)) for a, b in zip(robots[same].tolist(), robots[same + reach].tolist(), strict=True)
        }
        reach += 1
    for first, second in sorted(pairs):
        if first != second and _overlap(
            before[second] - before[first], velocity[second] - velocity[first], problem.size
        ):
            faults.add(int(time[tick + 1]), f"robots {first} and {second} overlap")


def _overlap(distance: Float, velocity: Float, side: float) -> bool:
    """Tell whether |distance + velocity * t| is below `side` on both axes at one t in [0, 1]."""
    begin, end = 0.0, 1.0
    for gap, speed in zip(distance.tolist(), velocity.tolist(), strict=True):
        if speed == 0:
            if abs(gap) >= side - TOUCH:
                return False
            continue
        times = sorted(((-side + TOUCH - gap) / speed, (side - TOUCH - gap) / speed))
        begin, end = max(begin, times[0]), min(end, times[1])
    return begin <= end
