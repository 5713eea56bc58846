"""Measure the first plans and the costs over time of anytime solvers, and compare them with LaCAM3 and LNS2.

    python benchmarks/anytime.py --data ../shared/data/movingai --anchors ../shared/data/anchors_anytime.csv
    python benchmarks/anytime.py --data … --anchors … --maps maze-32-32-2 --solvers lacam "lns initial=lacam"
    python benchmarks/anytime.py --data … --anchors … --first

Runs every map, scenario and number of robots that the table has a measurement for with the longest limit; `--subset n`
takes every n-th. All costs are sums of arrival times. Of the others the best of the
settings of LaCAM3 and LNS2 counts, in each column by itself: the one with the earliest first plan need not be the one
with the cheapest in the end. `ours/theirs` compares the best of our solvers with the best of theirs at the end: 1 or
less is no costlier; first plans that take less than 5 ms are alike. With `--first`, only first plans count, of all
instances for which LaCAM3 has one, in CPU seconds and as the median of three: this is quick, and valid on a busy
machine. The others were measured on another day on a machine of the same kind.
"""

import argparse
import csv
import math
import statistics
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from movingai import LEAST_S, MapfInstance, algorithm_of, read_instance
from mrpbench_native import solve

EARLY_S = 1.0
OTHERS = ("lacam3", "LNS2")


class CostCurve(NamedTuple):
    """The cost of an anytime solver over time."""

    first: float
    """Seconds to the first plan; infinite: none."""
    early: float
    """Cost after `EARLY_S`."""
    last: float
    """Cost at the end."""


NOTHING = CostCurve(math.inf, math.inf, math.inf)


def measured(file: Path, limit: float) -> dict[MapfInstance, CostCurve]:
    """The best of the table in each column, for instances that were measured with this limit."""
    best: dict[MapfInstance, CostCurve] = {}
    long = set()
    with file.open() as stream:
        for row in csv.DictReader(stream):
            instance = MapfInstance(row["map"], row["scen"], int(row["k"]))
            if not row["solver"].startswith(OTHERS):
                continue
            if float(row["time_limit"]) == limit and row["solver"] in OTHERS:
                long.add(instance)
            best[instance] = cheapest([best.get(instance, NOTHING), curve_of(row, limit)])
    return {instance: curve for instance, curve in best.items() if instance in long}


def soonest(file: Path) -> dict[MapfInstance, float]:
    """Seconds to the first plan of the quickest setting of LaCAM3, for all instances that one of them solved."""
    best: dict[MapfInstance, float] = {}
    with file.open() as stream:
        for row in csv.DictReader(stream):
            if row["solver"].startswith("lacam3") and row["solved"] == "1":
                instance = MapfInstance(row["map"], row["scen"], int(row["k"]))
                best[instance] = min(best.get(instance, math.inf), float(row["seconds_to_first"]))
    return best


def curve_of(row: Mapping[str, str], limit: float) -> CostCurve:
    """One line of the table; a cost that is not known for some time does not count then."""
    if row["solved"] != "1":
        return NOTHING
    ended, cost = float(row["time_limit"]), float(row["soc_final"])
    return CostCurve(
        float(row["seconds_to_first"]), cost if ended <= EARLY_S else math.inf, cost if ended <= limit else math.inf
    )


def cheapest(curves: Sequence[CostCurve]) -> CostCurve:
    """The least in each column."""
    return CostCurve(*map(min, zip(*curves, strict=True)))


def solved(data: Path, instance: MapfInstance, solver: str, limit: float) -> CostCurve:
    """Ours."""
    algorithm, options = algorithm_of(solver)
    solution = solve(*read_instance(data, instance), algorithm=algorithm, time_limit=limit, **options)
    if solution.cost is None:
        return NOTHING
    history = solution.history[:, :2].tolist()
    early = min((cost for seconds, cost in history if seconds <= EARLY_S), default=math.inf)
    return CostCurve(history[0][0], early, solution.cost)


def first(data: Path, instance: MapfInstance, limit: float) -> float:
    """CPU seconds to our first plan, the median of three."""
    asked = read_instance(data, instance)
    solutions = [solve(*asked, algorithm="lacam", time_limit=limit, iterations=0) for _ in range(3)]
    return statistics.median(one.cpu_seconds if one.cost is not None else math.inf for one in solutions)


def line(instance: MapfInstance, found: Sequence[CostCurve], theirs: CostCurve) -> str:
    """The curves of our solvers, then of the best of theirs, by column."""
    ratio = cheapest(found).last / theirs.last if math.isfinite(theirs.last) else math.nan
    cells = [
        *(f"{curve.first:9.3f}" for curve in (*found, theirs)),
        *(f"{curve.early:9.0f}" for curve in (*found, theirs)),
        *(f"{curve.last:9.0f}" for curve in (*found, theirs)),
    ]
    return f"{instance.map:<24}{instance.scen:<10}{instance.agents:>6}{''.join(cells)}{ratio:10.4f}"


def table(
    instances: Sequence[MapfInstance], anchors: Mapping[MapfInstance, CostCurve], arguments: argparse.Namespace
) -> Iterator[str]:
    """A line for each instance, and what they come to."""
    solvers = [*arguments.solvers, "theirs"]
    names = [f"{solver[:8]:>9}" for solver in solvers]
    groups = [f"{name:>{9 * len(solvers)}}" for name in ("first plan, s", f"cost at {EARLY_S:g} s", "cost at the end")]
    yield f"{'':<40}{''.join(groups)}"
    yield f"{'map':<24}{'scen':<10}{'robots':>6}{''.join(names * 3)}{'ours/theirs':>12}"
    ratios, sooner = [], 0
    for instance in instances:
        found = [solved(arguments.data, instance, solver, arguments.time_limit) for solver in arguments.solvers]
        theirs = anchors[instance]
        sooner += cheapest(found).first <= max(theirs.first, LEAST_S)
        if math.isfinite(theirs.last):
            ratios.append(cheapest(found).last / theirs.last)
        yield line(instance, found, theirs)
    if ratios:
        yield (
            f"first plan no later: {sooner} of {len(instances)}; no costlier: {sum(r <= 1 for r in ratios)} of "
            f"{len(ratios)} that both solved; geometric mean {statistics.geometric_mean(ratios):.4f}"
        )


def first_plans(
    instances: Sequence[MapfInstance], anchors: Mapping[MapfInstance, float], arguments: argparse.Namespace
) -> Iterator[str]:
    """A line for each instance, and how many first plans of `lacam` come no later."""
    yield f"{'map':<24}{'scen':<10}{'robots':>6}{'lacam, s':>10}{'theirs, s':>10}"
    sooner = 0
    for instance in instances:
        ours, theirs = first(arguments.data, instance, arguments.time_limit), anchors[instance]
        late = ours > max(theirs, LEAST_S)
        sooner += not late
        yield (f"{instance.map:<24}{instance.scen:<10}{instance.agents:>6}{ours:10.3f}{theirs:10.3f}{'  later' * late}")
    yield f"first plan no later: {sooner} of {len(instances)}"


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True, help="folder with maps/ and scens/")
    parser.add_argument("--anchors", type=Path, required=True, help="table of what others reach")
    parser.add_argument("--solvers", nargs="+", default=["lacam", "lns"], help="each with options, as 'lns seed=1'")
    parser.add_argument("--maps", nargs="*", default=[])
    parser.add_argument("--agents", nargs="*", type=int, default=[])
    parser.add_argument("--scens", nargs="*", default=[])
    parser.add_argument("--subset", type=int, default=1, metavar="N", help="every N-th instance only")
    parser.add_argument("--time-limit", type=float, default=10.0)
    parser.add_argument("--first", action="store_true", help="only when lacam has its first plan, in CPU seconds")
    arguments = parser.parse_args()
    anchors: Mapping[MapfInstance, Any] = (
        soonest(arguments.anchors) if arguments.first else measured(arguments.anchors, arguments.time_limit)
    )
    chosen = [
        one
        for one in sorted(anchors)
        if (not arguments.maps or one.map in arguments.maps)
        and (not arguments.agents or one.agents in arguments.agents)
        and (not arguments.scens or one.scen in arguments.scens)
    ]
    rows = first_plans if arguments.first else table
    for text in rows(chosen[:: arguments.subset], anchors, arguments):
        print(text, flush=True)


if __name__ == "__main__":
    main()
