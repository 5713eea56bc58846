"""Scenario files of the MovingAI benchmarks.

Stern et al., "Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks", SoCS 2019. Each row is one robot:
bucket, map, width, height, start x, start y, goal x, goal y, distance; x = column, y = row *from the top*.
"""

from pathlib import Path
from typing import ClassVar, NamedTuple

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class MovingAiScenario(ScenarioSource):
    """The first rows of a MovingAI `.scen` file, on the map it was made for. Each row gives a robot its goal."""

    gives_goals: ClassVar[bool] = True

    file: Path = option(help="the .scen file")
    robots: int = option(help="number of robots: the first rows of the file", validator=attrs.validators.ge(1))

    def size(self) -> int:
        """Return the option `robots`."""
        return self.robots

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the scenario, which is the same for every seed."""
        raster = world.levels[0].occupancy if world.levels else None
        if raster is None:
            raise InputError(
                f"world {world.name} is not a raster, so columns and rows have no place in it", file=self.file
            )
        rows = _read_rows(self.file, self.robots)
        start = np.array([self._centre(raster, row, row.start, "start") for row in rows])
        goals = [self._centre(raster, row, row.goal, "goal") for row in rows]
        return Scenario(
            start=start,
            start_level=np.zeros(len(rows), np.int16),
            tasks=tuple(Task(goals=goal[None, :]) for goal in goals),
        )

    def _centre(self, raster: Occupancy, row: "_Row", cell: tuple[int, int], what: str) -> Float:
        """Pose f8[3] of a cell's centre, any yaw."""
        height, width = raster.shape
        x, y = cell
        if row.size != (width, height):
            message = f"is for a map of {row.size[0]} x {row.size[1]} cells, the world has {width} x {height}"
        elif not (0 <= x < width and 0 <= y < height):
            message = f"{what} ({x}, {y}) lies outside the map of {width} x {height} cells"
        elif raster.blocked[height - 1 - y, x]:
            message = f"{what} ({x}, {y}) is blocked"
        else:
            return np.append(raster.centres(np.array([[height - 1 - y, x]])), np.nan)
        raise InputError(message, file=self.file, line=row.line)


class _Row(NamedTuple):
    """One robot."""

    line: int
    size: tuple[int, int]
    """Width, height of the map."""
    start: tuple[int, int]
    goal: tuple[int, int]


def _read_rows(file: Path, wanted: int) -> list[_Row]:
    """The first `wanted` rows.

    Raises:
        InputError: the file is not a scenario, or has fewer rows.
    """
    first, *lines = read_text(file).splitlines() or [""]
    if first.split()[:1] != ["version"]:
        raise InputError("is not a MovingAI scenario: the first line is not 'version 1'", file=file, line=1)
    rows: list[_Row] = []
    for number, line in enumerate(lines, start=2):
        if len(rows) == wanted:
            break
        if line.strip():
            rows.append(_read_row(file, number, line))
    if len(rows) < wanted:
        raise InputError(f"has {len(rows)} rows, too few for {wanted} robots", file=file)
    return rows


def _read_row(file: Path, number: int, line: str) -> _Row:
    fields = line.split("\t") if "\t" in line else line.split()  # tabs allow map names with blanks
    if len(fields) != 9:
        raise InputError(f"a row has 9 fields, this one {len(fields)}", file=file, line=number)
    try:
        width, height, start_x, start_y, goal_x, goal_y = (int(field) for field in fields[2:8])
    except ValueError:
        raise InputError("map size, start and goal must be whole numbers", file=file, line=number) from None
    return _Row(number, (width, height), (start_x, start_y), (goal_x, goal_y))
