"""`mrpbench saturate STUDY [key=value…]`: find the rate of tasks at which queues begin to grow."""

import argparse
import json
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.report.reading.axes import NO_AXES, find_axes, name_axes
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.arrivals import arrivals
from mrpbench_search.asking.requests import Requests, SearchEnded, read_whole_study, seeds_of
from mrpbench_search.asking.variants import patched, read_variants
from mrpbench_search.saturation.rates import TOLERANCE, Growth, growth, next_rate, saturation

COLUMN = ".open_growth"
UNITS = {"rate": "tasks/min", "scale": "1/scale"}
"""Options of task sources that give the rate; the rate of a trace is the reciprocal of its option."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        f"Queues are bounded at a rate if fewer than {TOLERANCE:.0%} of the tasks pile up, and grow if more do, each"
        " with 95 % confidence over seeds. Exit code: 0 every saturation rate has an interval, 1 some have none, 2 the"
        " configuration is wrong, 130 interrupted (the same command continues)."
    )
    add_search(parser, "results/NAME-saturate")
    parser.add_argument(
        "--resolution",
        type=float,
        default=0.05,
        metavar="X",
        help="least distance between neighbouring rates, as a share from 0.01 to 1 (default: %(default)s)",
    )


@attrs.define
class Search:
    """The search of one combination."""

    label: str
    first: float
    tried: dict[float, Growth] = attrs.field(factory=dict)
    failed: dict[float, int] = attrs.field(factory=dict)
    """Runs that did not succeed, by rate; their growth counts too."""
    fault: str | None = None

    def next(self, resolution: float) -> float | None:
        """The rate to try, or None at the end."""
        verdicts = {rate: estimate.verdict for rate, estimate in self.tried.items()}
        return None if self.fault else next_rate(verdicts, self.first, resolution)

    @property
    def interval(self) -> tuple[float | None, float | None]:
        """The interval of the saturation rate."""
        return saturation({rate: estimate.verdict for rate, estimate in self.tried.items()})

    def judge(self, rate: float, records: Sequence[Mapping[str, Any]]) -> None:
        """Add the growth that the records of a rate show; seeds are the sample."""
        shares: dict[int, list[float]] = defaultdict(list)
        for record in records:
            metrics = record.get("metrics") or {}
            share = next((value for name, value in metrics.items() if name.endswith(COLUMN)), None)
            if share is None:
                why = "fewer than two tasks arrive after the warm-up, or the run was not measured"
                self.fault = f"at {rate:.4g}, run {record['run_id']} ({record['status']}) has no growth: {why}"
                return
            shares[record["seed"]].append(share)
        self.tried[rate] = growth([sum(values) / len(values) for values in shares.values()])
        self.failed[rate] = sum(record["status"] != RunStatus.SUCCEEDED for record in records)

    def row(self, rate: float) -> list[str]:
        """What was found at a rate."""
        estimate = self.tried[rate]
        failed = f"{self.failed[rate]} failed" if self.failed[rate] else ""
        return [
            f"{rate:.4g}",
            f"{estimate.mean:.3f}",
            f"{estimate.low:.3f}",
            f"{estimate.high:.3f}",
            estimate.verdict,
            failed,
        ]


def run(arguments: argparse.Namespace) -> int:
    """Search the rates and print them."""
    file, overrides = study_of(arguments)
    if not 0.01 <= arguments.resolution <= 1:
        raise InputError(f"--resolution {arguments.resolution:g}: from 0.01 to 1")
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        option = _option(study)
        points = _by_combination(study, option)
        searches = _searches(study, option, points)
        out = Path(arguments.out or f"results/{study.name}-saturate")
        with searching(arguments, out, overrides) as requests:
            end = _search(requests, study, option, points, searches, arguments.resolution)
    _print(list(searches.values()), UNITS[option], out, end, arguments.json)
    return int(any(None in search.interval for search in searches.values()))


def _search(
    requests: Requests,
    study: StudyRuns,
    option: str,
    points: Mapping[str, Sequence[StudyRun]],
    searches: Mapping[str, Search],
    resolution: float,
) -> str | None:
    """Try rates until no interval becomes shorter; return why the search ended before, if it did."""
    while wanted := _wanted(searches, resolution):
        for rate, keys in wanted.items():
            print(f"trying {rate:.4g} {UNITS[option]}: {'; '.join(searches[key].label for key in keys)}")
        try:
            _try(requests, study, option, points, searches, wanted)
        except SearchEnded as end:
            return str(end)
        for rate, keys in wanted.items():
            for search in (searches[key] for key in keys if rate in searches[key].tried):
                _, mean, low, high, verdict, failed = search.row(rate)
                runs = f" ({failed})" if failed else ""
                print(f"{search.label}: growth {mean} [{low}, {high}] at {rate:.4g}: {verdict}{runs}", flush=True)
    return None


def _option(study: StudyRuns) -> str:
    """The option that gives the rate, which all runs have."""
    blocks = [arrivals(point.canonical)[1] for point in study.runs]
    for option in UNITS:
        if all(option in block for block in blocks):
            break
    else:
        without = next((block for block in blocks if not UNITS.keys() & block.keys()), None)
        reason = "all combinations must have `rate`, or all `scale`"
        if without is not None:
            reason = f"{without['plugin']!r} has no rate" if without else "the study has no task source"
        raise InputError(f"tasks: {reason}", hint="use `poisson`, `pickup_delivery` or `trace`")
    return option


def _key(point: StudyRun, option: str) -> str:
    """The same text for the runs of a combination."""
    config = patched(point.canonical, {f"{arrivals(point.canonical)[0]}.{option}": None})
    return json.dumps({key: value for key, value in config.items() if key not in NO_AXES})


def _by_combination(study: StudyRuns, option: str) -> dict[str, list[StudyRun]]:
    """The runs of each combination of the matrix."""
    points: dict[str, list[StudyRun]] = defaultdict(list)
    for point in study.runs:
        points[_key(point, option)].append(point)
    for each in points.values():
        if len(seeds_of(each)) < 2:
            raise InputError("seed: a rate is judged by two seeds or more", hint="e.g. seed=0..4")
    return points


def _searches(study: StudyRuns, option: str, points: Mapping[str, Sequence[StudyRun]]) -> dict[str, Search]:
    """One search for each combination."""
    labels = map(name_axes, find_axes([json.loads(key) for key in points]))
    starts = (float(arrivals(each[0].canonical)[1][option]) for each in points.values())
    return {
        key: Search(label or study.name, start if option == "rate" else 1 / start)
        for key, label, start in zip(points, labels, starts, strict=True)
    }


def _wanted(searches: Mapping[str, Search], resolution: float) -> dict[float, list[str]]:
    """The combinations by the rate that each tries next."""
    wanted: dict[float, list[str]] = defaultdict(list)
    for key, search in searches.items():
        if (rate := search.next(resolution)) is not None:
            wanted[rate].append(key)
    return wanted


def _try(
    requests: Requests,
    study: StudyRuns,
    option: str,
    points: Mapping[str, Sequence[StudyRun]],
    searches: Mapping[str, Search],
    wanted: Mapping[float, Sequence[str]],
) -> None:
    """Do the runs of one step of all searches, and judge them."""
    chosen: dict[tuple[float, str], tuple[StudyRun, ...]] = {}
    for rate, keys in wanted.items():
        for key in keys:
            value = {f"{arrivals(points[key][0].canonical)[0]}.{option}": rate if option == "rate" else 1 / rate}
            samples = [{name: point.canonical[name] for name in ("seed", "repeat")} for point in points[key]]
            changes = [value | sample for sample in samples]
            chosen[rate, key] = read_variants(study, points[key][0], changes, changes).runs
    results = requests.results(study, [point for each in chosen.values() for point in each])
    for (rate, key), each in chosen.items():
        searches[key].judge(rate, [results[point.run_id] for point in each])


def _print(searches: Sequence[Search], unit: str, out: Path, end: str | None, as_json: bool) -> None:
    if as_json:
        rows = [attrs.asdict(search) | {"interval": search.interval} for search in searches]
        for row, search in zip(rows, searches, strict=True):
            row["tried"] = [
                {"rate": rate, **attrs.asdict(estimate), "verdict": estimate.verdict, "failed": search.failed[rate]}
                for rate, estimate in search.tried.items()
            ]
            del row["failed"]
        print_json({"unit": unit, "tolerance": TOLERANCE, "out": str(out), "ended": end, "combinations": rows})
        return
    for search in searches:
        print()
        table = [search.row(rate) for rate in sorted(search.tried)]
        columns = [unit, "growth", "low", "high", "queues", *(["runs"] if any(search.failed.values()) else [])]
        print_table(columns, [row[: len(columns)] for row in table], search.label)
        low, high = ("–" if end is None else f"{end:.4g}" for end in search.interval)
        print(f"saturation rate: {low} to {high} {unit}" + (f"; stopped: {search.fault}" if search.fault else ""))
    print(f"\ngrowth: share of the tasks that piles up, with one-sided 95 % limits; runs are in {out}")
    if end:
        print(f"the search ended before: {end}")
    elif any(None in search.interval for search in searches):
        print("an end is missing: longer runs or more seeds show more")
