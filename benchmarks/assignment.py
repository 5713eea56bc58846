"""Measure planners that assign and find paths together, and compare them with the reference solvers.

    python benchmarks/assignment.py --data ../shared/data
    python benchmarks/assignment.py --data ../shared/data --solver ita_cbs --against ITACBS_remake

The instances are those of libMultiRobotPlanning's `cbs_ta` benchmark (YAML files in `mapf_ta/`); in `g5` five robots
each share their goals, in `anon` all do. A time is the median of `--repeat` runs, distance tables included; ratios are
geometric means over the instances that both solved, ours by theirs: `ratio` counts less than 5 ms as 5 ms, as in
`movingai.py`, `raw` does not. The others were measured on another day on a machine of the same kind.
"""

import argparse
import csv
import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml
from movingai import Outcome, algorithm_of, outcome_of, ratio
from mrpbench_native import solve

PAIRS = {
    "cbs_ta": "cbs_ta",
    "ita_cbs": "ITACBS_remake",
    "ecbs_ta w=1.3": "ecbs_ta-w1.3",
    "ita_ecbs w=1.3": "ITA_ECBS-w1.3",
}
"""Ours and, in the table of measurements, theirs."""


class AssignmentInstance(NamedTuple):
    """Agents on a map, and which of them share their goals."""

    set: str
    agents: int
    ex: int
    mode: str


class Question(NamedTuple):
    """An instance as the solver receives it."""

    free: np.ndarray
    starts: list[list[int]]
    goals: list[list[list[int]]]


def measured(file: Path, solver: str, limit: float) -> dict[AssignmentInstance, Outcome]:
    """The measured outcomes of `solver`."""
    found = {}
    with file.open() as stream:
        for row in csv.DictReader(stream):
            if row["solver"] == solver and float(row["time_limit"]) == limit:
                instance = AssignmentInstance(row["set"], int(row["k"]), int(row["ex"]), row["goal_mode"])
                found[instance] = outcome_of(row)
    return found


def load(data: Path, instance: AssignmentInstance) -> Question:
    """Read the YAML file of an instance."""
    size, _, obstacles = instance.set.partition("_obst")
    side = size.partition("x")[0]
    name = f"map_{side}by{side}_obst{obstacles}_agents{instance.agents}_ex{instance.ex}.yaml"
    drawn = yaml.safe_load((data / "mapf_ta" / name).read_text())
    width, height = drawn["map"]["dimensions"]
    free = np.ones((height, width), bool)
    for x, y in drawn["map"]["obstacles"]:
        free[y, x] = False
    starts = [agent["start"][::-1] for agent in drawn["agents"]]
    goals = [agent["goal"][::-1] for agent in drawn["agents"]]
    share = 5 if instance.mode == "g5" else instance.agents
    groups = [goals[first : first + share] for first in range(0, instance.agents, share)]
    return Question(free, starts, [groups[robot // share] for robot in range(instance.agents)])


def run(question: Question, solver: str, limit: float, repeat: int) -> Outcome:
    """The median outcome of a solver on an instance."""
    algorithm, options = algorithm_of(solver)
    found = []
    for _ in range(repeat):
        solution = solve(*question, algorithm=algorithm, time_limit=limit, **options)
        if solution.status != "solved" or solution.cost is None:
            return Outcome(math.inf, math.nan)
        found.append(Outcome(solution.seconds, solution.cost))
    return sorted(found)[len(found) // 2]


def table(found: dict[AssignmentInstance, Outcome], others: dict[AssignmentInstance, Outcome]) -> Iterator[str]:
    """One line for each number of robots and mode, and for all."""
    rows: dict[tuple[str, int, str], list[AssignmentInstance]] = {}
    for instance in sorted(found):
        for key in ((instance.set, instance.agents, instance.mode), ("all", 0, "")):
            rows.setdefault(key, []).append(instance)
    yield f"{'set':<16}{'robots':>7} {'goals':<6}{'n':>4}{'solved':>8}{'theirs':>8}{'ratio':>8}{'raw':>8}{'max s':>9}"
    for (name, agents, mode), members in sorted(rows.items(), key=lambda row: (row[0][0] == "all", row[0])):
        ours, theirs = [found[one] for one in members], [others[one] for one in members]
        solved = [sum(math.isfinite(it.seconds) for it in them) for them in (ours, theirs)]
        slowest = max((it.seconds for it in ours if math.isfinite(it.seconds)), default=math.nan)
        yield (
            f"{name:<16}{agents or '':>7} {mode:<6}{len(members):>4}{solved[0]:>8}{solved[1]:>8}"
            f"{ratio(ours, theirs):>8.2f}{ratio(ours, theirs, 0.0):>8.3f}{slowest:>9.4f}"
        )


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, help="folder with mapf_ta/ and anchors_assignment.csv")
    parser.add_argument("--solver", help="an algorithm and its options, such as 'ecbs_ta w=1.3'; default: all four")
    parser.add_argument("--against", help="a solver of the table of measurements")
    parser.add_argument("--time-limit", type=float, default=5.0)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--least", type=float, default=0.0, help="leave out what the others solve in fewer seconds")
    arguments = parser.parse_args()
    pairs = {arguments.solver: arguments.against or PAIRS.get(arguments.solver)} if arguments.solver else PAIRS
    for solver, against in pairs.items():
        others = measured(arguments.data / "anchors_assignment.csv", against or "", arguments.time_limit)
        found = {
            one: run(load(arguments.data, one), solver, arguments.time_limit, arguments.repeat)
            for one in sorted(others)
            if others[one].seconds >= arguments.least
        }
        print(f"{solver} against {against}")
        print("\n".join(table(found, others)), flush=True)


if __name__ == "__main__":
    main()
