"""Every published optimum of the MovingAI benchmark, for one planner: no solution is cheaper, no lower bound is higher,
and a planner that promises the optimum finds it.

    python soak_optima.py --shared ../shared/data --planner cbs --limit 10
    python soak_optima.py --shared ../shared/data --planner "eecbs w=1.2" --limit 1 --first 100 --count 50

The limit is in CPU seconds for each instance, so that other work on the machine changes nothing but the wall time.
`make optima` runs all planners that promise something about costs.
"""

import argparse
import csv
import sys
import time
from collections import Counter
from itertools import islice
from pathlib import Path as File

from mrpbench_planners_mapf.bounded import Ecbs, Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.lns import Lns
from mrpbench_tests.instances.problems import movingai
from mrpbench_tests.oracles.judge import answer_faults

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.planning.plan import Budget

PLANNERS: dict[str, type[Planner]] = {
    "cbs": Cbs,
    "cbs_ta": CbsTa,
    "ecbs": Ecbs,
    "ecbs_ta": EcbsTa,
    "eecbs": Eecbs,
    "ita_cbs": ItaCbs,
    "ita_ecbs": ItaEcbs,
    "lacam": Lacam,
    "lns": Lns,
}
PATIENCE = 6
"""Wall seconds of the machine that a planner is given for each CPU second that it may use."""
ANYTIME = (Lacam, Lns)
"""Use all the time that they get, so that patience would only be waited for."""


def planner_of(words: str) -> Planner:
    """The planner `name option=value...`, with numbers as options."""
    name, *options = words.split()
    return PLANNERS[name](**{option: float(value) for option, _, value in (word.partition("=") for word in options)})


def main() -> int:
    """Print what is wrong, what was not finished, and how much was; the number of faults."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=File, required=True, help="folder with movingai/ and mapf_optimal.csv")
    parser.add_argument("--planner", required=True, help=f"one of {', '.join(PLANNERS)}, and w=VALUE where it has one")
    parser.add_argument("--limit", type=float, default=10.0, help="CPU seconds for each instance")
    parser.add_argument("--first", type=int, default=0, help="row to begin with")
    parser.add_argument("--count", type=int, default=None, help="rows at most")
    arguments = parser.parse_args()
    planner = planner_of(arguments.planner)
    wall_s = arguments.limit if isinstance(planner, ANYTIME) else PATIENCE * arguments.limit
    budget = Budget(wall_s=wall_s, memory_bytes=4 << 30)
    last = None if arguments.count is None else arguments.first + arguments.count
    wrong, ends, spent = 0, Counter[str](), 0.0
    with (arguments.shared / "mapf_optimal.csv").open() as file:
        for row in islice(csv.DictReader(file), arguments.first, last):
            asked, optimum = movingai(arguments.shared, row["map"], row["scen"], int(row["agents"])), int(row["soc"])
            name = f"{row['map']} {row['scen']} {row['agents']}"
            began = time.process_time()
            result = planner.plan(asked, budget)
            seconds = time.process_time() - began
            spent += seconds
            for fault in answer_faults(asked, planner, result, optimum):
                wrong += 1
                print(f"{name}, {arguments.planner}: {fault}", flush=True)
            if result.plan is None:
                ends["not finished"] += 1
                print(f"# {name}: {result.status} after {seconds:.1f} s, bound {result.lower_bound:.0f} of {optimum}")
            else:
                ends["within the limit"] += seconds <= arguments.limit
                ends["optimal"] += result.plan.sum_of_costs == optimum
                ends["solved"] += 1
        print(f"{arguments.planner}: rows from {arguments.first}: {dict(ends)}, {wrong} faults, {spent:.0f} CPU s")
    return wrong


if __name__ == "__main__":
    sys.exit(main() > 0)
