"""The planner `external`: writes the problem as MovingAI files, runs a solver on them, and reads its paths."""

import itertools
import os
import re
import shlex
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any, ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Planner, Promise, option
from mrpbench_core.model.planning.plan import Budget, Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_external.movingai import vertex_at, why_not, write_map, write_scen
from mrpbench_planners_external.outputs import READERS, Cells, UnreadableError
from mrpbench_planners_external.presets import GENERAL, PRESETS, Output, PresetName
from mrpbench_planners_external.process import run

FIELDS = ("map", "scen", "paths", "agents", "seconds", "seed", "w")
"""Names that the arguments may contain in braces."""
_MARGIN_S = 0.5
"""Time beyond its own limit that a solver gets to write its answer."""
_UNSOLVED = re.compile(r"^solved=0\s*$", re.MULTILINE)
"""A line with which PIBT2 and LaCAM say that they found no paths."""


def _runs(_: Any, __: "attrs.Attribute[Path]", value: Path) -> None:
    if not value.is_file() or not os.access(value, os.X_OK):
        raise ValueError(f"{value} is not an executable program")


def _splits(_: Any, __: "attrs.Attribute[str]", value: str) -> None:
    if value:
        _names_fields(_, __, "{map} " + value)


def _names_fields(_: Any, __: Any, value: str | None) -> None:
    if value is None:
        return
    try:
        shlex.split(value.format_map(dict.fromkeys(FIELDS, "")))
    except (KeyError, ValueError, IndexError) as error:
        known = ", ".join(f"{{{name}}}" for name in FIELDS)
        raise ValueError(f"cannot be filled in: {error}; it may use {known}") from error
    if "{map}" not in value:
        raise ValueError("must hand over {map}")


def _is_given_where_needed(planner: "External", _: "attrs.Attribute[float | None]", value: float | None) -> None:
    if value is None and "{w}" in planner.command_line:
        raise ValueError("w is missing: the arguments hand over {w}")
    if value is None and Promise.BOUNDED in planner.promised:
        raise ValueError("w is missing: the promise `bounded` refers to it")


@attrs.frozen(kw_only=True)
class External(Planner):
    """Runs any solver as a separate program, so that solvers under any licence appear in the same tables.

    Supports grids with moves of one tick, one goal for each robot, and no footprints. The planning time is the time of
    the process, including reading and writing of files.
    """

    supports: ClassVar[frozenset[Feature]] = frozenset()

    binary: Path = option(help="the program to run", validator=_runs)
    preset: PresetName | None = option(
        None, help="take arguments and output of a known program: EECBS, CBSH2-RTC, MAPF-LNS2, or LaCAM, also 2 and 3"
    )
    label: str = option("", help="name of this planner in reports, instead of its options; part of the run's identity")
    arguments: str | None = option(
        None,
        help="its arguments: {map} and {scen} are the files to read, {paths} the file to write, {agents} the number of "
        "robots, {seconds} the time limit in seconds, {seed} a seed, {w} the option w; none = of the preset, or "
        f"`{GENERAL.arguments}`",
        validator=_names_fields,
    )
    more_arguments: str = option("", help="further arguments after these", validator=_splits)
    output: Output | None = option(
        None,
        help="format of the paths: as CBSH2-RTC and EECBS, as PIBT2 and LaCAM, or as libMultiRobotPlanning; none = of "
        "the preset, or `agents`",
    )
    w: float | None = option(
        None,
        help="factor of suboptimality, for the arguments and the promise `bounded`",
        validator=attrs.validators.and_(attrs.validators.optional(attrs.validators.ge(1)), _is_given_where_needed),
    )
    promised: tuple[Promise, ...] = option(
        (Promise.CONFLICT_FREE,), help="what every plan of the program keeps; runs and reports check it"
    )
    seed: int | None = option(
        None,
        help="handed to the program as {seed}; without it drawn from the run's seed and repeat, below 2^31",
        validator=attrs.validators.optional(attrs.validators.ge(0)),
    )

    @property
    def promises(self) -> frozenset[Promise]:  # type: ignore[override]
        """What the option `promised` says."""
        return frozenset(self.promised)

    @property
    def suboptimality(self) -> float:
        """The option `w`."""
        return self.w or 1.0

    @property
    def command_line(self) -> str:
        """The arguments, with placeholders."""
        known = PRESETS[self.preset] if self.preset else GENERAL
        return f"{self.arguments or known.arguments} {self.more_arguments}".rstrip()

    @property
    def format(self) -> Output:
        """The format of the paths."""
        return self.output or (PRESETS[self.preset] if self.preset else GENERAL).output

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also problems that cannot be written as a map of cells."""
        return super().skip(problem) or why_not(problem)

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:
        """Run the program; `GAVE_UP` if it writes no paths.

        Raises:
            RuntimeError: the program failed, or its output is not in the format.
        """
        with tempfile.TemporaryDirectory(prefix="mrpbench-external-") as name:
            folder = Path(name)
            write_map(problem.roadmap, folder / "world.map")
            write_scen(problem, "world.map", folder / "world.scen")
            ended = run(self._command(len(problem), budget), folder, budget.wall_s, budget.memory_bytes)
            statistics = {"process_s": ended.seconds, "process_cpu_s": ended.cpu_s}
            if ended.resident > 0:  # a program that ends at once is not measured
                statistics["memory_bytes"] = ended.resident
            if ended.limit is not None:
                status = PlanStatus.TIMEOUT if ended.limit == "time" else PlanStatus.OUT_OF_MEMORY
                return PlanResult(status=status, statistics=statistics)
            if ended.code != 0:
                last = (ended.output.strip().splitlines() or ["without output"])[-1]
                raise RuntimeError(f"{self.binary.name} ended with exit code {ended.code}: {last}")
            answer = folder / "paths.txt"
            text = answer.read_text(errors="replace") if answer.is_file() else ""
            if "{paths}" not in self.command_line:
                text = ended.output
        if not text.strip() or (self.format == "steps" and _UNSOLVED.search(text)):
            return PlanResult(status=PlanStatus.GAVE_UP, statistics=statistics)
        try:
            plan = Plan(paths=tuple(_paths(problem, READERS[self.format](text))))
        except UnreadableError as error:
            raise RuntimeError(
                f"the output of {self.binary.name} is not in the format {self.format!r}: {error}"
            ) from error
        return PlanResult(status=PlanStatus.SOLVED, plan=plan, statistics=statistics)

    def _command(self, robots: int, budget: Budget) -> list[str]:
        fields = {
            "map": "world.map",
            "scen": "world.scen",
            "paths": "paths.txt",
            "agents": robots,
            "seconds": f"{max(0.1, budget.wall_s - _MARGIN_S):g}",
            "seed": budget.seed if self.seed is None else self.seed,
            "w": "" if self.w is None else f"{self.w:g}",
        }
        return [str(self.binary.resolve()), *(word.format_map(fields) for word in shlex.split(self.command_line))]


def _paths(problem: Problem, cells: Cells) -> Iterable[RobotPath]:
    """Timed paths along edges of the roadmap; the engine judges whether they solve the problem."""
    if len(cells) != len(problem):
        raise UnreadableError(f"it has paths of {len(cells)} robots instead of {len(problem)}")
    vertex = vertex_at(problem.roadmap)
    edge = {(int(tail), int(head)): index for index, (tail, head) in enumerate(problem.roadmap.edges.tolist())}
    for robot, path in enumerate(cells):
        steps = []
        for before, after in itertools.pairwise(path):
            if before == after:
                steps.append(-1)
                continue
            move = vertex.get(before), vertex.get(after)
            if move not in edge:
                raise UnreadableError(f"robot {robot} moves from cell {before} to {after} (row, column)")
            steps.append(edge[move])
        if not path or vertex.get(path[0]) != problem.start[robot]:
            raise UnreadableError(f"robot {robot} does not begin at its start")
        time = np.arange(len(steps) + 1, dtype=np.int64)
        yield RobotPath(edge=np.array(steps, np.int32), enter=time[:-1], leave=time[1:])
