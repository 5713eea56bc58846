"""Compares throughputs in POGEMA with those published of RHCR: python benchmarks/pogema_lifelong.py [--maps 32].

POGEMA runs in its own environment (`make pogema`), draws the goals and moves the robots; every five steps a planner
plans the next ten for the goals that come, as RHCR does (Li et al., AAAI 2021) with PBS, the published one. The
problems are those of the set `01-random`: its maps, seed 0, 256 steps. Published means, of 128 maps each, were counted
in the results of https://github.com/CognitiveAISystems/pogema-benchmark. Robots whose planner gives up stay.
"""

import argparse
import itertools
import pickle
import statistics
import subprocess
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import yaml
from mrpbench_policies.maps import MOVES
from mrpbench_policies.pogema.files import read_map

from mrpbench_core.api import Budget, Fleet, Goals, Int, Level, Occupancy, Planner, Problem, Roadmap, World
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.config.study import load_study
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.planning.goals import first_problem
from mrpbench_core.model.planning.problem import features_of

ROOT = Path(__file__).parents[1]
POGEMA = ROOT / "build" / "pogema"
PUBLISHED = {32: 2.286, 64: 3.819}
"""Mean goals a step of RHCR, by number of robots."""
WINDOW, PERIOD, STEPS = 10, 5, 256
ROBOT = load_robot("turtlebot3_burger")


class Pogema:
    """An environment of POGEMA in a process of its own."""

    def __init__(self) -> None:
        server = ROOT / "plugins/policies/tests/observations/pogema_process.py"
        python = POGEMA / "bin" / "python"
        self._process = subprocess.Popen([python, server], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self, what: str, value: Any) -> Any:
        """Return the answer to a request; see the file of the process."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        pickle.dump((what, value), self._process.stdin)
        self._process.stdin.flush()
        return pickle.load(self._process.stdout)  # noqa: S301 - of our own process


@attrs.frozen(kw_only=True, eq=False)
class Raster:
    """The roadmap of a map, with rows from the top as in POGEMA."""

    roadmap: Roadmap
    vertex: Int
    """i8[rows,columns], -1 = blocked."""

    @classmethod
    def of(cls, blocked: Any) -> "Raster":
        """Return the roadmap of the cells that are not blocked."""
        world = World(name="map", levels=(Level(name="L1", occupancy=Occupancy(blocked=blocked[::-1], resolution=1)),))
        roadmap = GridRoadmap(cell_size=1).build(world, Fleet(robots=(ROBOT,)))
        assert roadmap.grid is not None
        vertex = np.full(blocked.shape, -1, np.int64)
        vertex[len(blocked) - 1 - roadmap.grid.cell[:, 0], roadmap.grid.cell[:, 1]] = np.arange(len(roadmap.position))
        return cls(roadmap=roadmap, vertex=vertex)

    def problem(self, places: Int, sequences: Any) -> Problem:
        """Return the problem of the next window."""
        goals: Goals = tuple(tuple((int(self.vertex[cell]),) for cell in sequence) for sequence in sequences)
        fleet, start = Fleet(robots=(ROBOT,) * len(places)), self.vertex[tuple(places.T)].astype(np.int32)
        problem = attrs.evolve(first_problem(self.roadmap, fleet, start, goals), horizon=WINDOW)
        return attrs.evolve(problem, features=features_of(problem))

    def cells(self, vertices: Int) -> Int:
        """Return rows and columns i8[n,2] of vertices i8[n]."""
        assert self.roadmap.grid is not None
        cell = self.roadmap.grid.cell[vertices]
        return np.column_stack([len(self.vertex) - 1 - cell[:, 0], cell[:, 1]])


def actions(raster: Raster, problem: Problem, planner: Planner) -> list[list[int]] | None:
    """Return the actions of each step of a period, or None if the planner has no plan."""
    plan = planner.plan(problem, Budget(wall_s=10.0, memory_bytes=2**30)).plan
    if plan is None:
        return None
    trace = np.tile(problem.start, (PERIOD + 1, 1)).astype(np.int64)
    head = raster.roadmap.edges[:, 1]
    for robot, path in enumerate(plan.paths):
        for edge, arrival in zip(path.edge.tolist(), path.leave.tolist(), strict=True):
            if edge >= 0 and arrival <= PERIOD:
                trace[arrival:, robot] = head[edge]
    steps = []
    for before, after in itertools.pairwise(trace):
        moves = raster.cells(after) - raster.cells(before)
        steps.append([int((move == MOVES).all(axis=1).argmax()) for move in moves])
    return steps


def throughput(pogema: Pogema, blocked: Any, text: str, robots: int, planner: Planner) -> tuple[float, int]:
    """Return the goals a step of one episode, and how often the planner had no plan."""
    raster, failures, steps = Raster.of(blocked), 0, 0
    config = {"map": text, "num_agents": robots, "seed": 0, "max_episode_steps": STEPS}
    _, places, _ = pogema.ask("reset", config | {"on_target": "restart", "collision_system": "soft"})
    while True:
        chosen = actions(raster, raster.problem(places, pogema.ask("goals", WINDOW + 1)), planner)
        failures += chosen is None
        answers = pogema.ask("steps", chosen or [[0] * robots] * PERIOD)
        steps += len(answers)
        _, places, _, _, _, truncated, metrics = answers[-1]
        if all(truncated):
            return float(metrics["avg_throughput"]), failures


def main() -> None:
    """Compare, and print a line for each number of robots."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planner", default="pbs", help="as in a study, e.g. '{plugin: pibt}'")
    parser.add_argument("--maps", type=int, default=128)
    parser.add_argument("--robots", type=int, nargs="*", choices=list(PUBLISHED), default=[32], help="64 take hours")
    wanted = parser.parse_args()
    study = {"world": "office", "scenario": {"robots": 1}, "planner": yaml.safe_load(wanted.planner)}
    planner = load_study(study).runs[0].config.planner
    file = POGEMA / "benchmark" / "algorithms" / "experiments" / "01-random" / "maps.yaml"
    texts = dict(list(yaml.safe_load(file.read_text()).items())[: wanted.maps])
    pogema = Pogema()
    for robots in wanted.robots:
        runs = [throughput(pogema, read_map(file, name), text, robots, planner) for name, text in texts.items()]
        rates = [rate for rate, _ in runs]
        reach = 1.96 * statistics.stdev(rates) / len(rates) ** 0.5
        failed = sum(failures for _, failures in runs)
        print(f"{robots} robots, {len(rates)} maps: {statistics.mean(rates):.3f} ± {reach:.3f} goals a step", end="")
        print(f" ({PUBLISHED[robots]:.3f} as published); {failed} windows without a plan", flush=True)


if __name__ == "__main__":
    main()
