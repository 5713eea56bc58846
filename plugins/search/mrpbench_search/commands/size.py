"""`mrpbench size STUDY --orders RATE [key=value…]`: find the smallest fleet that serves a stream of orders."""

import argparse
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.text import counted
from mrpbench_core.model.common.units import quantity
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.configurations import only_configuration
from mrpbench_search.asking.requests import Requests, SearchEnded, read_whole_study, seeds_of
from mrpbench_search.asking.variants import read_variants
from mrpbench_search.saturation.rates import TOLERANCE, growth
from mrpbench_search.sizing.fleets import FleetFigures, Verdict, limits, next_size, smallest

_RATE = re.compile(r"([\d.]+) ?(?:/|an? |per )? ?(h|hour|min|minute)")
MINUTES = {"h": 60, "hour": 60, "min": 1, "minute": 1}
ALL_BUSY = 0.9
"""Utilisation from which on the robots are what is lacking."""


@attrs.define(kw_only=True)
class Fleets:
    """The search: the fleets that were tried, and why larger ones were not."""

    study: StudyRuns
    points: Sequence[StudyRun]
    rate: float
    """Orders per minute."""
    bound_s: float
    requests: Requests
    tried: dict[int, FleetFigures] = attrs.field(factory=dict, init=False)
    most: int = attrs.field(default=10**6, init=False)
    limit: str = attrs.field(default="", init=False)
    """Why no larger fleet can be tried."""

    @property
    def verdicts(self) -> dict[int, Verdict]:
        """What is shown of each fleet."""
        return {size: found.verdict(self.bound_s) for size, found in self.tried.items()}

    def run(self, first: int) -> str | None:
        """Try fleets until the interval cannot be made shorter; return why the search ended before, if it did."""
        while (size := next_size(self.verdicts, first, self.most)) is not None:
            print(f"trying {counted(size, 'robot')}", flush=True)
            try:
                self._try(size)
            except SearchEnded as end:
                return str(end)
            if size in self.tried:
                print(f"{counted(size, 'robot')}: {self.verdicts[size]}", flush=True)
        return None

    def _try(self, size: int) -> None:
        changes = [
            {
                "scenario.robots": size,
                "tasks.rate": self.rate,
                "seed": point.canonical["seed"],
                "repeat": point.canonical["repeat"],
            }
            for point in self.points
        ]
        labels = [{"robots": size, "seed": point.canonical["seed"]} for point in self.points]
        study = read_variants(self.study, self.points[0], changes, labels)
        try:
            results = self.requests.results(study, study.runs)
        except InputErrors as several:  # the scenario has no room for so many
            if not self.tried or size < max(self.tried):
                raise
            self.most, self.limit = max(self.tried), several.errors[0].message
            return
        self.tried[size] = figures([results[point.run_id] for point in study.runs], size)


def figures(records: Sequence[Mapping[str, Any]], robots: int) -> FleetFigures:
    """Return what the records of a fleet show; seeds are the sample.

    Raises:
        InputError: a run measures no tasks.
    """
    by_seed: dict[int, list[Mapping[str, Any]]] = {}
    for record in records:
        by_seed.setdefault(record["seed"], []).append(record)
    if any(record["metrics"].get("tasks.open_growth") is None for record in records):
        bad = next(record for record in records if record["metrics"].get("tasks.open_growth") is None)
        raise InputError(
            f"run {bad['run_id']} ({bad['status']}) has no growth: fewer than two orders arrive after the warm-up, or"
            " the run was not measured",
            hint="longer runs (`limits.execution`)",
        )
    p95 = [_mean(found, "tasks.service_p95_s") for found in by_seed.values()]
    blocked = _mean(records, "execution.time_blocked_s") / robots
    return FleetFigures(
        growth=growth([_mean(found, "tasks.open_growth") for found in by_seed.values()]),
        p95=limits(p95) if np.isfinite(p95).all() else None,
        per_hour=_mean(records, "tasks.per_hour"),
        utilisation=_mean(records, "tasks.utilisation"),
        blocked=blocked / records[0]["config"]["limits"]["execution"],
        failed=sum(record["status"] != RunStatus.SUCCEEDED for record in records),
    )


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        f"A fleet serves the orders if fewer than {TOLERANCE:.0%} of them pile up and the 95th percentile of their"
        " service times is below --p95, each with 95 % confidence over seeds. Exit code: 0 the smallest fleet is known,"
        " 1 it is not, 2 the configuration is wrong, 130 interrupted (the same command continues)."
    )
    add_search(parser, "results/NAME-size")
    parser.add_argument("--orders", required=True, metavar="RATE", help="orders that arrive, e.g. `300/h` or `5/min`")
    parser.add_argument("--p95", metavar="TIME", help="bound of the 95th percentile of service times, e.g. `4min`")


def run(arguments: argparse.Namespace) -> int:
    """Search the fleet and print it."""
    file, overrides = study_of(arguments)
    rate, bound_s = _rate(arguments.orders), _bound(arguments.p95)
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        points = only_configuration(study)
        _check(points)
        out = Path(arguments.out or f"results/{study.name}-size")
        with searching(arguments, out, overrides) as requests:
            fleets = Fleets(study=study, points=points, rate=rate, bound_s=bound_s, requests=requests)
            end = fleets.run(points[0].canonical["scenario"]["robots"])
    low, high = smallest(fleets.verdicts)
    said = sentence(study.name, fleets, arguments.orders, arguments.p95)
    if arguments.json:
        print_json(
            {
                "answer": said,
                "interval": [low, high],
                "orders_per_min": rate,
                "p95_s": bound_s if math.isfinite(bound_s) else None,
                "fleets": [
                    {"robots": size, "verdict": fleets.verdicts[size], **attrs.asdict(fleets.tried[size])}
                    for size in sorted(fleets.tried)
                ],
                "runs": len(requests.asked),
                "ended": end,
                "out": str(out),
            }
        )
    else:
        _print(said, fleets, len(requests.asked), end, out)
    return int(low != high)


def sentence(name: str, fleets: Fleets, orders: str, p95: str | None) -> str:
    """Say which fleet is the smallest one that serves the orders, and what the next smaller one lacks."""
    low, high = smallest(fleets.verdicts)
    load = f"{orders} orders" + (f" within {p95}" if p95 else "")
    if high is None:
        if not fleets.tried:
            return f"{name}: nothing is shown"
        largest = max(fleets.tried)
        why = f": {fleets.limit}" if fleets.limit else f": {lacking(fleets.tried[largest])} run out first"
        return f"{name}: up to {counted(largest, 'robot')} no fleet is shown to serve {load}{why}"
    parts = [f"{counted(high, 'robot')} serve{'s' if high == 1 else ''} {load}"]
    if (found := fleets.tried[high].p95) is not None:
        parts[0] += f" (p95 {found.mean:.0f} s, at most {found.high:.0f} s)"
    if low < high:
        parts.append(f"{low} may do, which these runs do not show")
    if low > 1:
        parts.append(f"{low - 1} {'does' if low == 2 else 'do'} not")
    return f"{name}: {'; '.join(parts)}"


def lacking(found: FleetFigures) -> str:
    """Return what a fleet lacks: robots that are busy all the time, or aisles in which they stand."""
    return "robots" if found.utilisation >= ALL_BUSY and found.blocked < 1 - ALL_BUSY else "aisles"


def _rate(text: str) -> float:
    found = _RATE.fullmatch(text.strip())
    try:
        rate = float(found[1]) / MINUTES[found[2]] if found else 0.0
    except ValueError:
        rate = 0.0
    if not rate > 0:
        raise InputError(f"--orders {text}: expected a rate", hint="e.g. `300/h` or `5/min`")
    return rate


def _bound(text: str | None) -> float:
    if text is None:
        return math.inf
    try:
        bound = quantity(text, "s")
    except ValueError:
        bound = 0.0
    if not bound > 0:
        raise InputError(f"--p95 {text}: expected a time", hint="e.g. `4min`")
    return float(bound)


def _check(points: Sequence[StudyRun]) -> None:
    config = points[0].canonical
    if not isinstance(config["tasks"], dict) or "rate" not in config["tasks"]:
        raise InputError("tasks: the study has no orders with a rate", hint="use `poisson` or `pickup_delivery`")
    if not isinstance(config["scenario"].get("robots"), int):
        raise InputError(f"scenario: {config['scenario']['plugin']!r} has no number of robots", hint="use `random`")
    if len(config["fleet"]) > 1 or config["fleet"][0]["count"] is not None:
        raise InputError("fleet: the number of robots varies, so name one kind of robot without a count")
    if len(seeds_of(points)) < 2:
        raise InputError("seed: a fleet is judged by two seeds or more", hint="e.g. seed=0..4")


def _mean(records: Sequence[Mapping[str, Any]], column: str) -> float:
    values = [value for record in records if (value := record["metrics"].get(column)) is not None]
    return float(np.mean(values)) if values else math.nan


def _print(said: str, fleets: Fleets, runs: int, end: str | None, out: Path) -> None:
    print(f"\n{said}")
    rows = []
    for size in sorted(fleets.tried):
        found = fleets.tried[size]
        p95 = None if found.p95 is None else f"{found.p95.mean:.1f} [{found.p95.low:.1f}, {found.p95.high:.1f}]"
        rows.append(
            [
                size,
                fleets.verdicts[size],
                f"{found.per_hour:.1f}",
                p95,
                found.growth.verdict,
                f"{found.utilisation:.0%}",
                f"{found.blocked:.0%}",
                found.failed,
            ]
        )
    print_table(["robots", "", "orders/h", "p95 [s]", "queues", "busy", "blocked", "failed"], rows)
    print(f"{counted(runs, 'run')} in {out}" + (f"; the search ended before: {end}" if end else ""))
