"""Executes runs of the core alone, before plugins are imported and processes are forked.

Python specializes the instructions of a function in its first calls (PEP 659), and libraries fill caches. A forked
process would do both for one run, on memory that is copied page by page as it is written to.
"""

import tempfile
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.api.planner import Planner
from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import Structure
from mrpbench_core.engine.run import execute
from mrpbench_core.model.planning.plan import Budget, Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.store.paths import RunPaths

TIMES = 10
"""Functions are specialized after eight calls."""
_RUN = {
    "name": "warm_up",
    "world": f"{__name__}:TwoCells",
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 1},
    "assigner": "identity",
    "planner": f"{__name__}:OneEdge",
    "simulator": "none",
    "metrics": [],
    "seed": 2,  # its goal is not its start
}


@attrs.frozen(kw_only=True)
class TwoCells(WorldSource):
    """Two free cells."""

    def load(self) -> World:
        """Return them."""
        return World(
            name="cells", levels=(Level(name="L1", occupancy=Occupancy(blocked=np.zeros((1, 2), bool), resolution=1)),)
        )


@attrs.frozen(kw_only=True)
class OneEdge(Planner):
    """Plans for one robot, whose goal is next to its start."""

    def plan(self, problem: Problem, budget: Budget) -> PlanResult:  # noqa: ARG002
        """Return the edge between them, or no edge if they are the same."""
        wanted = problem.start[0], problem.goals[0][0][0]
        edge = np.flatnonzero((problem.roadmap.edges == wanted).all(axis=1))
        ticks = np.arange(len(edge))
        path = RobotPath(edge=edge.astype(np.int32), enter=ticks, leave=ticks + 1)
        return PlanResult(status=PlanStatus.SOLVED, plan=Plan(paths=(path,)))


def warm_up() -> None:
    """Execute such runs; nothing is written."""
    with tempfile.TemporaryDirectory() as folder:
        paths = RunPaths(recording=Path(folder, "recording.zip"), exports=Path(folder, "exports"))
        for _ in range(TIMES):
            config = Structure(Path(folder)).run(from_data(_RUN, Location()))
            record = execute(config, "0", paths)
            record.message()
