"""Compare conflict-based search with the reference solvers, on every instance on which these were measured.

    python benchmarks/anchors.py --shared ../shared/data
    python benchmarks/anchors.py --shared ../shared/data --solvers "eecbs w=1.2" --maps maze-32-32-2 random-32-32-20

`movingai.py` explains the columns. The whole benchmark takes up to an hour, because unsolved instances use their whole
time limit. `--solvable` leaves out the instances that the reference solvers did not solve.
"""

import argparse
import math
from pathlib import Path

from movingai import MapfInstance, Outcome, measured, run, table

CONTESTS = {
    "cbs": ("CBSH2-RTC",),
    "eecbs w=1.2": ("EECBS-w1.2", "EECBS-sipp-w1.2"),
    "eecbs w=1.05": ("EECBS-w1.05",),
    "ecbs w=1.2": ("libMRP-ecbs-w1.2",),
}
"""Our solver, and the reference solvers, of which the better one counts."""


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path, required=True, help="folder with movingai/ and anchors.csv")
    parser.add_argument("--solvers", nargs="*", default=list(CONTESTS), choices=list(CONTESTS))
    parser.add_argument("--maps", nargs="*", default=[])
    parser.add_argument("--each", action="store_true", help="a line for each number of robots too")
    parser.add_argument("--solvable", action="store_true", help="only instances that the other solvers solved")
    parser.add_argument("--time-limit", type=float, default=10.0, help="CPU seconds")
    parser.add_argument("--repeat", type=int, default=1)
    arguments = parser.parse_args()
    for solver in arguments.solvers:
        others = measured(arguments.shared / "anchors.csv", CONTESTS[solver])
        found: dict[MapfInstance, Outcome] = {}
        for instance in sorted(others):
            if arguments.maps and instance.map not in arguments.maps:
                continue
            if arguments.solvable and math.isinf(others[instance].seconds):
                continue
            ran = run(arguments.shared / "movingai", instance, solver, arguments.time_limit, arguments.repeat)
            if ran is not None:
                found[instance] = ran[0]
        print(f"{solver} against {', '.join(CONTESTS[solver])}")
        print("\n".join(table(found, others, arguments.each)), "\n", flush=True)


if __name__ == "__main__":
    main()
