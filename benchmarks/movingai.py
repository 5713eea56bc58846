"""Measure how many MovingAI instances a solver solves and how fast, and compare it with other solvers.

    python benchmarks/movingai.py --data ../shared/data/movingai --solver cbs --maps empty-8-8 --agents 8 16 24
    python benchmarks/movingai.py --data ../shared/data/movingai --anchors ../shared/data/anchors.csv \
        --solver "eecbs w=1.2" --against EECBS-w1.2 EECBS-sipp-w1.2
    python benchmarks/movingai.py --data … --maps empty-8-8 --solver "eecbs w=1.2" --baseline 'external binary=./eecbs
        arguments="-m {map} -a {scen} --outputPaths {paths} -k {agents} -t {seconds} --suboptimality 1.2"'

A solver is an algorithm of `mrpbench_native` or any planner that is installed, with its options; for anytime solvers
there is `anytime.py`. With `--against`, the instances are those that these solvers were measured on, and the best of
them counts; with `--baseline`, that solver runs in their place, each instance right after ours. A time is the median
of `--repeat` runs in CPU seconds of one thread, distance tables included: on an idle machine that is the wall time,
on a busy one it is still the solver's own. A solver that needs more than `--time-limit` has not solved the
instance. Less than 5 ms counts as 5 ms. Ratios are geometric means over the instances that both
solved: ours by theirs, so less than 1 is faster. Of a program that `external` runs, all its time counts, with the
reading of its files. Times in the table were measured on another day on a machine of the same kind, and leave
distance tables out: that is to their advantage.
"""

import argparse
import csv
import math
import shlex
import statistics
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mrpbench_native import ALGORITHMS, Solution, solve
from numpy.typing import NDArray
from problem_building import grid_problem, solve_by_planner

from mrpbench_core.files.errors import InputError, InputErrors

LEAST_S = 0.005
PASSABLE = ".GS"
PATIENCE = 2
"""Wall seconds of the machine that a solver is given for each CPU second that it may use."""


class MapfInstance(NamedTuple):
    """The first `agents` rows of a scenario file."""

    map: str
    scen: str
    agents: int


class Outcome(NamedTuple):
    """The outcome of a solver on an instance."""

    seconds: float
    """infinite: not solved."""
    cost: float


UNKNOWN = Outcome(math.nan, math.nan)


@cache
def read_map(file: Path) -> NDArray[np.bool_]:
    """Free cells bool[rows, columns]."""
    lines = file.read_text().splitlines()
    rows = lines[lines.index("map") + 1 :]
    return np.array([[cell in PASSABLE for cell in row] for row in rows if row])


@cache
def read_scen(file: Path, agents: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Starts and goals i8[agents,2], row and column."""
    rows = [line.split()[4:8] for line in file.read_text().splitlines()[1:] if line.strip()][:agents]
    places = np.array(rows, np.int64).reshape(-1, 2, 2)[..., ::-1]
    return places[:, 0], places[:, 1]


def files(data: Path, instance: MapfInstance) -> tuple[Path, Path]:
    """Map and scenario."""
    return data / "maps" / f"{instance.map}.map", data / "scens" / f"{instance.map}-{instance.scen}.scen"


def read_instance(data: Path, instance: MapfInstance) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.int64]]:
    """Free cells, starts and goals; fewer than `agents` if the scenario has fewer rows."""
    world, scen = files(data, instance)
    return read_map(world), *read_scen(scen, instance.agents)


def outcome_of(row: Mapping[str, str]) -> Outcome:
    """The outcome in one line of a table of measurements."""
    if row["solved"] != "1":
        return Outcome(math.inf, math.nan)
    return Outcome(float(row["seconds"]), float(row["cost"] or "nan"))


def measured(file: Path, solvers: Sequence[str], limit: float = 10.0) -> dict[MapfInstance, Outcome]:
    """The best measured result of any of `solvers`, from a table of measurements."""
    best: dict[MapfInstance, Outcome] = {}
    with file.open() as stream:
        for row in csv.DictReader(stream):
            if row["solver"] not in solvers or float(row["time_limit"]) != limit:
                continue
            instance = MapfInstance(row["map"], row["scen"], int(row["k"]))
            found = outcome_of(row)
            best[instance] = min(best.get(instance, found), found)
    return best


def attempt(data: Path, instance: MapfInstance, solver: str, limit: float) -> Solution:
    """Run a solver on an instance for so many seconds of wall time."""
    name, options = algorithm_of(solver)
    if name in ALGORITHMS:
        return solve(*read_instance(data, instance), algorithm=name, time_limit=limit, **options)
    problem = grid_problem(*files(data, instance), instance.agents)
    return Solution(status="unsolvable") if problem is None else solve_by_planner(name, options, problem, limit)


def run(data: Path, instance: MapfInstance, solver: str, limit: float, repeat: int) -> tuple[Outcome, Solution] | None:
    """The median outcome, and a solution; None if the scenario has fewer rows."""
    if len(read_instance(data, instance)[1]) < instance.agents:
        return None
    outcomes = []
    for _ in range(repeat):
        solution = attempt(data, instance, solver, PATIENCE * limit)
        solved = solution.status == "solved" and solution.cpu_seconds <= limit and solution.cost is not None
        outcomes.append(Outcome(solution.cpu_seconds, solution.cost or 0) if solved else Outcome(math.inf, math.nan))
        if not solved or 2 * solution.cpu_seconds > limit:
            break
    return sorted(outcomes)[len(outcomes) // 2], solution


def algorithm_of(solver: str) -> tuple[str, dict[str, Any]]:
    """An algorithm and its options from words such as `ecbs w=1.2`; words with spaces in quotes."""
    algorithm, *words = shlex.split(solver)
    return algorithm, dict(map(_option, words))


def _option(word: str) -> tuple[str, Any]:
    """An option from `name=value`."""
    name, _, value = word.partition("=")
    if value in ("true", "false"):
        return name, value == "true"
    for kind in (int, float):
        try:
            return name, kind(value)
        except ValueError:
            continue
    return name, value


def instances(arguments: argparse.Namespace, others: Mapping[MapfInstance, Outcome]) -> list[MapfInstance]:
    """Those of the table, or those that the arguments span."""
    if others:
        return sorted(one for one in others if not arguments.maps or one.map in arguments.maps)
    scens = [f"random-{number}" for number in range(1, arguments.scens + 1)]
    return [MapfInstance(name, scen, k) for name in arguments.maps for k in arguments.agents for scen in scens]


def ratio(ours: Sequence[Outcome], theirs: Sequence[Outcome], least: float = LEAST_S) -> float:
    """Geometric mean of the ratios of times, each at least `least`, where both have solved; NaN if nowhere."""
    both = [(a.seconds, b.seconds) for a, b in zip(ours, theirs, strict=True) if math.isfinite(a.seconds + b.seconds)]
    return statistics.geometric_mean(max(a, least) / max(b, least) for a, b in both) if both else math.nan


def line(
    title: str,
    members: Sequence[MapfInstance],
    found: Mapping[MapfInstance, Outcome],
    others: Mapping[MapfInstance, Outcome],
) -> str:
    """A line of the table for some instances."""
    ours = [found[one] for one in members]
    theirs = [others.get(one, UNKNOWN) for one in members]
    times = [[outcome.seconds for outcome in outcomes] for outcomes in (ours, theirs)]
    solved = [f"{sum(map(math.isfinite, seconds)):>8}" for seconds in times]
    medians = [f"{statistics.median(seconds):>10.4f}" for seconds in times]
    return f"{title:<31}{len(members):>5}{''.join(solved + medians)}{ratio(ours, theirs):>8.2f}"


HEADER = f"{'map':<24}{'robots':>7}{'n':>5}{'solved':>8}{'theirs':>8}{'median s':>10}{'theirs':>10}{'ratio':>8}"


def table(
    found: Mapping[MapfInstance, Outcome], others: Mapping[MapfInstance, Outcome], each: bool = True
) -> Iterator[str]:
    """One line for each map (with `each`, also for each number of robots), and one for all."""
    rows: dict[tuple[str, str], list[MapfInstance]] = defaultdict(list)
    for instance in found:
        if each:
            rows[instance.map, f"{instance.agents}"].append(instance)
        rows[instance.map, "all"].append(instance)
        rows["all", "all"].append(instance)
    order = sorted(rows, key=lambda row: (row[0] == "all", row[0], row[1].zfill(6)))
    yield HEADER
    for name, agents in order:
        yield line(f"{name:<24}{agents:>7}", rows[name, agents], found, others)


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, help="folder with maps/ and scens/")
    parser.add_argument("--solver", default="cbs", help="a solver and its options, such as 'eecbs w=1.2'")
    parser.add_argument("--maps", nargs="*", default=[])
    parser.add_argument("--agents", nargs="*", type=int, default=[10])
    parser.add_argument("--scens", type=int, default=5, help="scenario files random-1 to random-N")
    parser.add_argument("--anchors", type=Path, help="table of what others reach")
    parser.add_argument("--against", nargs="*", default=[], help="solvers in that table")
    parser.add_argument("--baseline", metavar="SOLVER", help="a solver that also runs, and with which ours is compared")
    parser.add_argument("--time-limit", type=float, default=10.0, help="CPU seconds")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--write", type=Path, help="file for one CSV row an instance")
    arguments = parser.parse_args()
    try:
        compare(arguments)
    except (OSError, ValueError, InputError, InputErrors) as error:
        sys.exit(f"{error}")


def compare(arguments: argparse.Namespace) -> None:
    """Run, write, and print."""
    others = measured(arguments.anchors, arguments.against) if arguments.anchors else {}
    found: dict[MapfInstance, Outcome] = {}
    rows = []
    contest = [(arguments.solver, found)] + ([(arguments.baseline, others)] if arguments.baseline else [])
    for instance in instances(arguments, others):
        for solver, outcomes in contest:
            if ran := run(arguments.data, instance, solver, arguments.time_limit, arguments.repeat):
                outcomes[instance], solution = ran
                rows.append([*instance, solver, solution.status, *outcomes[instance], solution.lower_bound])
    if arguments.solver == "cbs" and not arguments.baseline:
        for instance, (_, cost) in found.items():
            if cost < others.get(instance, UNKNOWN).cost:
                print(f"{instance}: cost {cost} is less than theirs, {others[instance].cost}, which was to be optimal")
    if arguments.write:
        with arguments.write.open("w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow(["map", "scen", "k", "solver", "status", "seconds", "cost", "lower_bound"])
            writer.writerows(rows)
    print("\n".join(table(found, others)))


if __name__ == "__main__":
    main()
