"""Writes a problem as the files of the MovingAI benchmark.

Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS 2019. Row 0 is the top of the map,
where y is largest.
"""

from pathlib import Path

import numpy as np

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Raster, Roadmap


def why_not(problem: Problem) -> str | None:
    """Return why a problem cannot be written as such files, as the end of a sentence about the planner, or None."""
    roadmap = problem.roadmap
    if roadmap.grid is None:
        return "needs a map of cells, which this roadmap does not have"
    if problem.rules.at_goal != "stay":
        return "needs robots that stay at their goals"
    usable = (roadmap.duration[problem.profile] >= 0).all(axis=0)
    if int(usable.sum()) != _neighbours(roadmap.grid):
        return "needs a map on which robots may move between any two neighbouring cells"
    return None


def write_map(roadmap: Roadmap, file: Path) -> None:
    """Write the cells of a roadmap: `.` where there is a vertex, `@` elsewhere."""
    assert roadmap.grid is not None
    rows, columns = roadmap.grid.shape
    cells = np.full((rows, columns), "@")
    row, column = _cells(roadmap.grid)
    cells[row, column] = "."
    lines = ("".join(line) for line in cells)
    file.write_text("\n".join(["type octile", f"height {rows}", f"width {columns}", "map", *lines, ""]))


def write_scen(problem: Problem, map_name: str, file: Path) -> None:
    """Write starts and goals, one robot per line; the last column, a distance that no solver needs, is 0."""
    grid = problem.roadmap.grid
    assert grid is not None
    rows, columns = grid.shape
    row, column = _cells(grid)
    lines = ["version 1"]
    for start, goals in zip(problem.start.tolist(), problem.goals, strict=True):
        (goal,) = goals[-1]
        places = (column[start], row[start], column[goal], row[goal])
        lines.append("\t".join(map(str, (0, map_name, columns, rows, *places, 0))))
    file.write_text("\n".join([*lines, ""]))


def vertex_at(roadmap: Roadmap) -> dict[tuple[int, int], int]:
    """The vertex of each cell, by row (from the top) and column."""
    assert roadmap.grid is not None
    row, column = _cells(roadmap.grid)
    return {cell: vertex for vertex, cell in enumerate(zip(row.tolist(), column.tolist(), strict=True))}


def _cells(grid: Raster) -> tuple[Int, Int]:
    """Row from the top and column i8[V] of each vertex."""
    return grid.shape[0] - 1 - grid.cell[:, 0].astype(np.int64), grid.cell[:, 1].astype(np.int64)


def _neighbours(grid: Raster) -> int:
    """Number of ordered pairs of cells side by side."""
    free = np.zeros(grid.shape, bool)
    free[grid.cell[:, 0], grid.cell[:, 1]] = True
    return 2 * int((free[1:] & free[:-1]).sum() + (free[:, 1:] & free[:, :-1]).sum())
