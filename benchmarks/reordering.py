"""Measure how many delay situations of the STPG benchmark are solved to proved optimality, and how fast.

    python benchmarks/reordering.py --data ../shared/data/stpg/situations.zip --time-limit 5 --every 12

Prints one line per map and delay: situations proved within the limit, CPU seconds of one thread (median, 95th
percentile, greatest), and the largest gap of the others. A time includes the grouping of decisions, but not the
reading of files.
"""

import argparse
import time
import zipfile
from collections import defaultdict
from pathlib import Path

import numpy as np
from mrpbench_native.mapf import reorder
from mrpbench_tests.instances.switchable import read_situation


def main() -> None:
    """Solve the situations and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, required=True, help="the benchmark's situations, a zip file")
    parser.add_argument("--time-limit", type=float, default=5.0, help="wall seconds for each situation")
    parser.add_argument("--every", type=int, default=1, help="take every so many-th situation")
    given = parser.parse_args()
    rows = defaultdict[str, list[tuple[float, float]]](list)
    with zipfile.ZipFile(given.data) as archive:
        for name in sorted(name for name in archive.namelist() if name.endswith(".json"))[:: given.every]:
            delay, _, file = name.split("/")
            arrays = read_situation(archive, name).arrays()
            begin = time.process_time()
            found = reorder(**arrays, wall_s=given.time_limit, memory_bytes=8 << 30)
            row = time.process_time() - begin, found.cost / found.lower_bound - 1
            for kind in (f"{file.removeprefix('map_').partition('_ins_')[0]} {delay}", "~ all"):
                rows[kind].append(row)
            if found.status != "solved":
                print(f"{name}: {found.planned_cost} -> {found.cost}, at least {found.lower_bound}", flush=True)
    print(f"{'situations':32} {'proved':>12} {'median':>8} {'p95':>8} {'most':>8} {'largest gap':>12}")
    for kind, measured in sorted(rows.items()):
        seconds, gaps = np.array(measured).T
        median, high, most = np.quantile(seconds, [0.5, 0.95, 1])
        proved = f"{(gaps == 0).sum()} of {len(gaps)}"
        print(f"{kind:32} {proved:>12} {median:8.3f} {high:8.3f} {most:8.3f} {gaps.max():12.2%}")


if __name__ == "__main__":
    main()
