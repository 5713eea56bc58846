"""Executes runs of studies by the rules of the League of Robot Runners."""

import math
from pathlib import Path
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api import Planner, between, option
from mrpbench_core.api.discrete import DiscreteResult, DiscreteRun, DiscreteSimulator
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import World
from mrpbench_league.channels import channels_of
from mrpbench_league.execute import Options, execute
from mrpbench_league.files.problem import LARGEST_POOL, Delays, LorrProblem, problem_reads, read_problem
from mrpbench_league.planner import StepPlanner

SECONDS = {2024: 1.0, 2026: 0.1}
"""Of a step or tick, as in the competition."""


@attrs.frozen(kw_only=True)
class Rules:
    """What a problem says besides its map, starts and tasks."""

    season: Literal[2024, 2026]
    counter: int
    size: float
    delays: Delays | None = None


@attrs.frozen(kw_only=True)
class League(DiscreteSimulator):
    """Executes tasks on the cells of a raster by the rules of the League of Robot Runners, with a greedy scheduler.
    Robots move one cell or turn by 90 degrees in a step. `tasks` must always keep the same number unfinished.
    """

    season: Literal[2024, 2026] = option(
        2024, help="2024: all robots act in steps; 2026: in ticks, at their own pace, on squares that must not overlap"
    )
    step: float | None = option(
        None,
        help="simulated time of a step or tick; none: 1 s, and 0.1 s in 2026",
        unit="s",
        validator=attrs.validators.optional(attrs.validators.gt(0)),
    )
    counter: int = option(10, help="ticks of a move or turn in 2026", validator=attrs.validators.in_(range(1, 1001)))
    size: float = option(
        1.0,
        help="side of a robot's square in 2026, in cells",
        validator=between(0.01, 1),
    )
    rules: Path | None = option(
        None, help="a problem file whose season, ticks, size and delays hold instead of these options"
    )
    preprocessing: float = option(
        30.0,
        help="time before the first step for distance tables, which counts as no answer; none with `limits.iterations`",
        unit="s",
        validator=between(0, 3600),
    )
    table_memory: int = option(
        2048,
        help="memory for distance tables in MiB; those used least recently are dropped and computed again when needed",
        validator=between(1, 2**20),
    )
    period: int = option(10, help="ticks between two calls of the planner in 2026", validator=attrs.validators.ge(1))

    def idle_options(self) -> dict[str, str]:
        """Return options that others make idle."""
        if self.rules is not None:
            return dict.fromkeys(("season", "counter", "size"), "`rules` names a problem")
        return {} if self.season == 2026 else dict.fromkeys(("counter", "size", "period"), "`season` is not 2026")

    def reads(self) -> tuple[Path, ...]:
        """Return the files that the problem names."""
        return () if self.rules is None else problem_reads(self.rules)

    def skip(self, planner: Planner) -> str | None:
        """Return why a planner cannot be executed: only `planner: league` plans steps."""
        return None if isinstance(planner, StepPlanner) else "`simulator: league` executes `planner: league` alone"

    def execute(self, run: DiscreteRun) -> DiscreteResult:
        """Execute a run."""
        assert isinstance(run.planner, StepPlanner)
        raster = raster_of(run.world)
        rules = Rules(season=self.season, counter=self.counter, size=self.size)
        if self.rules is not None:
            rules = rules_of(self.rules)
        seconds = self.step or SECONDS[rules.season]
        steps = math.floor(run.duration / seconds + 1e-9)
        if not 1 <= steps <= 10**6:
            raise InputError(f"limits.execution: {run.duration:g} s are {steps} steps of {seconds:g} s, not 1 to 10^6")
        start = cells_of(raster, run.scenario.start, "the start of a robot")
        if len(np.unique(start)) < len(start):
            raise InputError("scenario: two robots start in one cell")
        options = Options(
            planner=run.planner.method,
            depth=run.planner.depth,
            improve=run.planner.improve,
            threads=run.planner.threads,
            guidance=run.planner.guidance,
            active=run.planner.active,
            limit=run.limit,
            iterations=run.iterations,
            preprocessing=self.preprocessing,
            table_mib=self.table_memory,
            period=self.period,
            seed=run.seed % 2**63,
        )
        tasks = list(run.stream.released(0.0, 0))
        pool, wanted = len(tasks), 0
        if not 1 <= pool <= LARGEST_POOL:
            raise InputError("tasks: `simulator: league` needs tasks from the start on", hint="use `closed_pool`")
        while True:
            wanted = max(2 * wanted, pool + _likely(raster, tasks, len(start), steps))
            tasks += run.stream.released(0.0, wanted - pool)
            if len(tasks) < wanted:
                raise InputError("tasks: `simulator: league` needs a pool without end")
            errands = [cells_of(raster, task.goals, f"an errand of task {task.index}") for task in tasks]
            if any(task.errands < len(task.goals) for task in tasks):
                raise InputError("tasks: errands of `simulator: league` have one place each")
            if any(task.service.any() for task in tasks):
                raise InputError("tasks: errands of `simulator: league` take no service time")
            problem = LorrProblem(
                season=rules.season,
                blocked=raster.blocked[::-1],
                start=start.astype(np.int32),
                errands=np.concatenate(errands).astype(np.int32),
                first=np.cumsum([0, *map(len, errands)]).astype(np.int32),
                reveal=(pool + 0.5) / len(start),
                counter=rules.counter if rules.season == 2026 else 1,
                size=rules.size if rules.season == 2026 else 1.0,
                delays=rules.delays,
            )
            done = execute(problem, steps, options)
            if len(done.output.tasks or ()) <= len(tasks):
                break
        run.exports.mkdir(parents=True, exist_ok=True)
        done.write(run.exports / "output.json")
        return DiscreteResult(
            channels=channels_of(done.output, tasks, raster, seconds, run.rate),
            calls=done.call_seconds.tolist(),
            overruns=done.late_calls,
            preprocessing=done.preprocessing_seconds,
        )


def rules_of(file: Path) -> Rules:
    """Return the rules of a problem.

    Raises:
        InputError: it cannot be read, or is of 2023.
    """
    problem = read_problem(file)
    if problem.season == 2023:
        raise InputError("is of 2023, which gives goals to robots itself", file=file, hint="use `mrpbench league-run`")
    return Rules(season=problem.season, counter=problem.counter, size=problem.size, delays=problem.delays)


def raster_of(world: World) -> Occupancy:
    """Return the raster of a world that is one.

    Raises:
        InputError: it is none.
    """
    level = world.levels[0] if len(world.levels) == 1 else None
    if level is None or level.occupancy is None or len(level.walls) or level.obstacles:
        hint = "`movingai` or a generated world"
        raise InputError(f"world: `simulator: league` needs a raster, which {world.name} is not", hint=hint)
    return level.occupancy


def cells_of(raster: Occupancy, poses: np.ndarray, what: str) -> Int:
    """Return the cells i8[k] of poses f8[k,3], counted row by row from the top left.

    Raises:
        InputError: a pose is not in a free cell.
    """
    rows, columns = raster.shape
    cell = raster.cells(poses[:, :2])
    inside = ((cell >= 0) & (cell < (rows, columns))).all(axis=1)
    if not inside.all() or raster.blocked[cell[:, 0], cell[:, 1]].any():
        raise InputError(f"{what} is not in a free cell of the raster")
    cells: Int = (rows - 1 - cell[:, 0]) * columns + cell[:, 1]
    return cells


def _likely(raster: Occupancy, tasks: list[Task], robots: int, steps: int) -> int:
    """More tasks than robots will do: twice what they would do on straight ways."""
    ways = [np.abs(np.diff(task.goals[:, :2], axis=0)).sum() for task in tasks]
    cells = max(1.0, float(np.mean(ways)) / raster.resolution + 0.25 * sum(raster.shape))
    return 1 + math.ceil(2 * robots * steps / cells)
