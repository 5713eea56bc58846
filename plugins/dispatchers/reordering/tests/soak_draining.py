"""Drains drawn plans with `gses`, `sadg` and `btpg` under drawn delays: `soak_draining.py EXECUTIONS SEED`.

Prints every execution in which robots wait forever or meet, and compares the sums of arrivals with those of `adg`. The
exit code is 1 if there are faults.
"""

import argparse
import sys
from collections import Counter

from mrpbench_dispatchers_reordering import Btpg, Gses, Sadg
from mrpbench_tests.execution.drawn_executions import drained

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.testing.faults import Fault

KINDS = {
    "plans": {},
    "resources": {"resources": True},
    "new plans": {"replans": 3},
    "resources, new plans": {"resources": True, "replans": 3},
}
DISPATCHERS = {
    "gses": Gses(),
    "gses, eager": Gses(period=0, lateness=0, gain=0.001, lookahead=1),
    "sadg": Sadg(period=3, gain=0.001, lookahead=1, max_deterministic_time=0.05),
    "btpg": Btpg(),
    "btpg, eager": Btpg(lookahead=1),
}


def main() -> int:
    """Run the executions, the kinds in turn."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("executions", type=int)
    parser.add_argument("seed", type=int)
    given = parser.parse_args()
    counts, faults = Counter[str](), 0
    for number in range(given.executions):
        kind = list(KINDS)[number % len(KINDS)]
        name = list(DISPATCHERS)[number // len(KINDS) % len(DISPATCHERS)]
        seed = [given.seed, number]
        try:
            ended = drained(DISPATCHERS[name], seed, **KINDS[kind])
        except Fault as fault:
            faults += 1
            print(f"{kind}, {name}, seed {seed}: {fault}", flush=True)
            continue
        kept = drained(Adg(), seed, **KINDS[kind])
        counts[f"{kind}, {name}: " + ("refused" if ended is None else "drained")] += 1
        if ended and kept:
            counts[f"{kind}, {name}: reordered"] += ended.reordered
            counts[f"{kind}, {name}: steps of robots in the order of the plan"] += kept.sum_of_arrivals
            counts[f"{kind}, {name}: steps of robots"] += ended.sum_of_arrivals
        if (number + 1) % 1000 == 0:
            print(f"# {number + 1} executions, {faults} faults", flush=True)
    for what, count in sorted(counts.items()):
        print(f"{what:70} {count:10}")
    print(f"{given.executions} executions of seed {given.seed}: {faults} faults")
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
