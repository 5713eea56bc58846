"""Starts and goals of POGEMA's benchmark."""

from pathlib import Path
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import (
    Fleet,
    Float,
    InputError,
    Int,
    Occupancy,
    Roadmap,
    Scenario,
    ScenarioSource,
    Task,
    World,
    option,
)
from mrpbench_policies.pogema.files import read_scenario


@attrs.frozen(kw_only=True)
class PogemaScenario(ScenarioSource):
    """The first robots of a list of starts and goals of POGEMA's benchmark, for the map that the world is named after
    and the seed of the run. In lifelong lists each robot visits its goals in order.
    """

    gives_goals: ClassVar[bool] = True

    file: Path = option(help="an experiment with a block `scenarios`, such as 01-random-mapf.yaml")
    robots: int = option(help="number of robots: the first of the list", validator=attrs.validators.ge(1))

    def size(self) -> int:
        """Return the option `robots`."""
        return self.robots

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the starts and goals of a seed."""
        listed = read_scenario(self.file, world.name, seed)
        if self.robots > len(listed.start):
            message = f"{listed.name} has {len(listed.start)} robots, too few for {self.robots}"
            raise InputError(message, file=self.file)
        raster = world.levels[0].occupancy if world.levels else None
        if raster is None:
            message = f"world {world.name} is not a raster, so rows and columns have no place in it"
            raise InputError(message, file=self.file, hint="use `world: pogema`")
        start = self._poses(raster, listed.start[: self.robots], f"{listed.name}: a start")
        tasks = tuple(
            Task(goals=goals, levels=np.zeros(len(goals), np.int16))
            for goals in (self._poses(raster, cells, f"{listed.name}: a goal") for cells in listed.goals[: self.robots])
        )
        return Scenario(start=start, start_level=np.zeros(self.robots, np.int16), tasks=tasks)

    def _poses(self, raster: Occupancy, cells: Int, what: str) -> Float:
        """Centres f8[k,3] of cells i8[k,2], any yaw."""
        rows, columns = raster.shape
        for row, column in cells.tolist():
            if not (row < rows and column < columns):
                message = f"{what} [{row}, {column}] lies outside the map of {rows} x {columns} cells"
                raise InputError(message, file=self.file)
            if raster.blocked[rows - 1 - row, column]:
                raise InputError(f"{what} [{row}, {column}] is blocked", file=self.file)
        centres = raster.centres(np.column_stack([rows - 1 - cells[:, 0], cells[:, 1]]))
        return np.column_stack([centres, np.full(len(cells), np.nan)])
