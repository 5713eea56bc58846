"""Starts of problems of the League of Robot Runners."""

from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.api.component import option
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World
from mrpbench_league.files.problem import LorrProblem, problem_reads, read_problem


@attrs.frozen(kw_only=True)
class LorrStarts(ScenarioSource):
    """The starts of a problem of the League of Robot Runners, on its map (`world: movingai`). Robots head east. Its
    tasks are those of `tasks: lorr`.
    """

    file: Path = option(help="the problem, a JSON file")
    robots: int | None = option(
        None,
        help="the first robots of the problem; none: all of them",
        validator=attrs.validators.optional(attrs.validators.ge(1)),
    )

    def reads(self) -> tuple[Path, ...]:
        """Return the files that the problem names."""
        return problem_reads(self.file)

    def size(self) -> int:
        """Return the number of robots."""
        return self.robots or len(read_problem(self.file).start)

    def draw(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> Scenario:  # noqa: ARG002
        """Return the starts, which are the same for every seed."""
        problem = read_problem(self.file)
        if len(fleet) > len(problem.start):
            raise InputError(f"has {len(problem.start)} robots, not {len(fleet)}", file=self.file)
        start = centres_of(self.file, problem, world, problem.start[: len(fleet)])
        start[:, 2] = 0.0
        return Scenario(start=start, start_level=np.zeros(len(start), np.int16), tasks=())


def centres_of(file: Path, problem: LorrProblem, world: World, cells: Int32) -> Float:
    """Return the poses f8[k,3] of cells of a problem in a world, any yaw.

    Raises:
        InputError: the world is not the map of the problem.
    """
    raster = world.levels[0].occupancy if world.levels else None
    if raster is None or not np.array_equal(raster.blocked[::-1], problem.blocked):
        raise InputError(f"world {world.name} is not the map of the problem", file=file, hint="use `world: movingai`")
    row, column = np.divmod(cells, raster.shape[1])
    centres = raster.centres(np.column_stack([raster.shape[0] - 1 - row, column]))
    return np.column_stack([centres, np.full(len(centres), np.nan)])
