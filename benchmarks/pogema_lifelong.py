"""Compares throughputs in POGEMA with those published of RHCR.

    python benchmarks/pogema_lifelong.py [--set 02-mazes] [--robots 32] [--maps 16] [--planner pbs]

POGEMA runs in its own environment (`make pogema`), draws the goals and moves the robots; every five steps a planner
plans the next ten for the goals that come, as RHCR does (Li et al., AAAI 2021) with PBS, the published one. The
problems are the maps of a set with seed 0. Published means, of 128 maps each, were counted in the results of
https://github.com/CognitiveAISystems/pogema-benchmark. Robots whose planner gives up stay.
"""

import argparse
import runpy
import statistics
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import yaml
from mrpbench_policies.board import Board, board_of
from mrpbench_policies.pogema.world import PogemaWorld

from mrpbench_core.api import Budget, Fleet, Goals, Int, Planner, Problem, Roadmap
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.config.study import load_study
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.planning.goals import first_problem
from mrpbench_core.model.planning.problem import features_of

ROOT = Path(__file__).parents[1]
PROBLEMS = ROOT / "build" / "pogema" / "benchmark" / "algorithms" / "experiments"
POGEMA = runpy.run_path(str(ROOT / "plugins/policies/tests/observations/soak_pogema.py"))["Pogema"]
"""Asks the process of POGEMA."""
PUBLISHED = {
    "01-random": {32: 2.286, 64: 3.819},
    "02-mazes": {32: 1.703, 64: 2.587},
}
"""Mean goals a step of RHCR, by set and number of robots."""
STEPS = {"01-random": 256, "02-mazes": 128}
"""Steps of an episode, by set."""
WINDOW, PERIOD = 10, 5
ROBOT = load_robot("turtlebot3_burger")


@attrs.frozen(kw_only=True, eq=False)
class Grid:
    """The roadmap of a map, and its cells with row 0 on top as in POGEMA."""

    roadmap: Roadmap
    board: Board
    action: Mapping[int, int]
    """The action that moves a robot along each edge."""

    @classmethod
    def of(cls, file: Path, name: str) -> "Grid":
        """Return the cells of a map of a file."""
        roadmap = GridRoadmap(cell_size=1).build(PogemaWorld(file=file, map=name).load(), Fleet(robots=(ROBOT,)))
        board = board_of(roadmap, 1)
        assert isinstance(board, Board), board
        actions = np.argwhere(board.leads >= 0)
        edges = board.leads[actions[:, 0], actions[:, 1]]
        return cls(roadmap=roadmap, board=board, action=dict(zip(edges.tolist(), actions[:, 1].tolist(), strict=True)))

    def vertices(self, cells: Any) -> Int:
        """Return the vertices i8[n] of cells i8[n,2]: rows and columns."""
        vertices: Int = self.board.vertex[self.board.maps.places(np.asarray(cells, np.int64)[None])[0]].astype(np.int64)
        return vertices

    def problem(self, places: Int, sequences: Any) -> Problem:
        """Return the problem of the next window."""
        goals: Goals = tuple(tuple((vertex,) for vertex in self.vertices(cells).tolist()) for cells in sequences)
        fleet, start = Fleet(robots=(ROBOT,) * len(places)), self.vertices(places).astype(np.int32)
        problem = attrs.evolve(first_problem(self.roadmap, fleet, start, goals), horizon=WINDOW)
        return attrs.evolve(problem, features=features_of(problem))

    def actions(self, problem: Problem, planner: Planner) -> list[list[int]] | None:
        """Return the actions of each step of a period, or None if the planner has no plan."""
        plan = planner.plan(problem, Budget(wall_s=10.0, memory_bytes=2**30)).plan
        if plan is None:
            return None
        steps = [[0] * len(problem) for _ in range(PERIOD)]
        for robot, path in enumerate(plan.paths):
            for edge, begin in zip(path.edge.tolist(), path.enter.tolist(), strict=True):
                if edge >= 0 and begin < PERIOD:
                    steps[begin][robot] = self.action[edge]
        return steps


def throughput(pogema: Any, grid: Grid, text: str, robots: int, steps: int, planner: Planner) -> tuple[float, int]:
    """Return the goals a step of one episode, and how often the planner had no plan."""
    failures = 0
    config = {"map": text, "num_agents": robots, "seed": 0, "max_episode_steps": steps}
    _, places, _ = pogema.reset(**config, on_target="restart", collision_system="soft")
    while True:
        chosen = grid.actions(grid.problem(places, pogema.goals(WINDOW + 1)), planner)
        failures += chosen is None
        answers = pogema.steps(chosen or [[0] * robots] * PERIOD)
        _, places, _, _, _, truncated, metrics = answers[-1]
        if all(truncated):
            return float(metrics["avg_throughput"]), failures


def main() -> None:
    """Compare, and print a line for each number of robots."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planner", default="pbs", help="as in a study, e.g. '{plugin: pibt}'")
    parser.add_argument("--maps", type=int, default=128)
    parser.add_argument("--set", choices=list(PUBLISHED), default="01-random")
    parser.add_argument("--robots", type=int, nargs="*", choices=[32, 64], default=[32], help="64 take hours")
    wanted = parser.parse_args()
    study = {"world": "office", "scenario": {"robots": 1}, "planner": yaml.safe_load(wanted.planner)}
    planner = load_study(study).runs[0].config.planner
    file = PROBLEMS / wanted.set / "maps.yaml"
    texts = dict(list(yaml.safe_load(file.read_text()).items())[: wanted.maps])
    pogema = POGEMA()
    for robots in wanted.robots:
        runs = [
            throughput(pogema, Grid.of(file, name), text, robots, STEPS[wanted.set], planner)
            for name, text in texts.items()
        ]
        rates = [rate for rate, _ in runs]
        reach = 1.96 * statistics.stdev(rates) / len(rates) ** 0.5
        failed = sum(failures for _, failures in runs)
        print(f"{robots} robots, {len(rates)} maps: {statistics.mean(rates):.3f} ± {reach:.3f} goals a step", end="")
        print(f" ({PUBLISHED[wanted.set][robots]:.3f} as published); {failed} windows without a plan", flush=True)
    pogema.close()


if __name__ == "__main__":
    main()
