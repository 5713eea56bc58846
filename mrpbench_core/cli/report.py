"""`mrpbench report DIR…`: what is in results folders, by configuration."""

import argparse
import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.cli.table import print_json, print_table
from mrpbench_core.config.mistakes import did_you_mean
from mrpbench_core.files.errors import InputError
from mrpbench_core.store.groups import Group, group
from mrpbench_core.store.results import Results, load

MAIN = (
    "planning.sum_of_costs",
    "planning.makespan",
    "timing.planning_s",
    "execution.duration_s",
    "execution.min_distance_m",
    "execution.time_blocked_s",
    "execution.robot_contacts",
)
"""Columns shown where no others are asked for and some run has them."""


ABREAST = 4
"""Groups that stand side by side, one row for each column of the table."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "One row for each configuration, over its seeds and repeats. A mean is over the runs that have the value; where"
        " these are not all runs, their number stands behind it. Infeasible and skipped runs leave the success rate."
    )
    parser.add_argument(
        "folders", nargs="+", metavar="DIR", help="results folders; of one run in several, the later wins"
    )
    parser.add_argument("--metrics", metavar="A,B", help="columns to show, or `all` (default: a few that matter)")
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.add_argument("--csv", metavar="FILE", help="write the table with all columns")


def run(arguments: argparse.Namespace) -> int:
    """Print or write the table."""
    results = [load(folder) for folder in arguments.folders]
    if not any(map(len, results)):
        raise InputError("no run is recorded here yet", file=arguments.folders[0])
    if arguments.json or arguments.csv:
        rows = [_facts(found) for found in group(_Records(results))]
        if arguments.csv:
            _write_csv(Path(arguments.csv), rows)
        if arguments.json:
            print_json(rows)
        return 0
    print_report(results, arguments.metrics)
    return 0


def print_report(results: Sequence[Results], metrics: str | None = None, limit: int | None = None) -> None:
    """Print a column for each group while they are few, else a row for each, at most `limit` of them."""
    groups = group(_Records(results))
    known = list(dict.fromkeys(key for found in groups for key in found.sums))
    wanted = known if metrics == "all" else metrics.split(",") if metrics else [key for key in MAIN if key in known]
    if unknown := [key for key in wanted if key not in known]:
        raise InputError(f"no run has a value of {unknown[0]!r}", hint=did_you_mean(unknown[0], known))
    axes = list(dict.fromkeys(key for found in groups for key in found.axes))
    table: dict[str, list[Any]] = {key: [found.axes.get(key) for found in groups] for key in axes}
    table["runs"] = [found.runs for found in groups]
    table["succeeded"] = [f"{found.statuses['succeeded']}/{found.counted}" for found in groups]
    others = dict.fromkeys(status for found in groups for status in found.statuses if status != "succeeded")
    table |= {status: [found.statuses[status] for found in groups] for status in others}
    table |= {key: [_mean(found, key) for found in groups] for key in wanted}
    if len(groups) <= ABREAST:
        print_table(
            ["", *(f"#{number + 1}" for number in range(len(groups)))], [[key, *row] for key, row in table.items()]
        )
    else:
        print_table(_short(list(table)), list(zip(*table.values(), strict=True))[:limit])
    if limit is not None and len(groups) > max(limit, ABREAST):
        print(f"… {len(groups) - limit} more rows: `mrpbench report {results[0].folder.path}`")


@attrs.frozen
class _Records:
    """Records of several folders, each run once; can be gone through again."""

    results: Sequence[Results]

    def __iter__(self) -> Iterator[dict[str, Any]]:
        for index, results in enumerate(self.results):
            for record in results:
                if not any(record["run_id"] in later for later in self.results[index + 1 :]):
                    yield record


def _short(columns: list[str]) -> list[str]:
    """Headings without the name of the metric, where they stay different."""
    short = [column.rpartition(".")[2] for column in columns]
    return [end if short.count(end) == 1 else column for end, column in zip(short, columns, strict=True)]


def _mean(found: Group, key: str) -> str | None:
    mean = found.mean(key)
    if mean is None:
        return None
    return f"{mean[0]:.4g}" + ("" if mean[1] == found.runs else f" (n={mean[1]})")


def _facts(found: Group) -> dict[str, Any]:
    means = {key: found.mean(key) for key in found.sums}
    return {
        "axes": found.axes,
        "runs": found.runs,
        "counted": found.counted,
        "statuses": dict(found.statuses),
        "means": {key: {"mean": mean[0], "n": mean[1]} for key, mean in means.items() if mean is not None},
    }


def _write_csv(file: Path, rows: list[dict[str, Any]]) -> None:
    flat = [
        row["axes"]
        | {"runs": row["runs"], "counted": row["counted"]}
        | {f"status.{status}": count for status, count in row["statuses"].items()}
        | {f"{key}{end}": mean[part] for key, mean in row["means"].items() for end, part in (("", "mean"), (".n", "n"))}
        for row in rows
    ]
    columns = list(dict.fromkeys(key for row in flat for key in row))
    try:
        with file.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, columns, restval="")
            writer.writeheader()
            writer.writerows(flat)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=file) from error
