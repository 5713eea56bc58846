"""Compares measured times with those of the same runs, done again here: only their distribution says anything.

Times of another machine cannot be verified. What is found is a clock that runs much faster than any machine explains.
CPU times are compared, because they depend little on the load, by medians of ratios.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mrpbench_core.engine.processes.machine import machine
from mrpbench_publish.bundles.checks.repetition import Pair

LEAST = 5
"""Pairs of runs below which nothing is said."""
SHORTEST_S = 1e-3
"""CPU seconds below which a time says more about the clock than about the planner."""
SAME_MACHINE = 2.0
"""Largest factor between two machines with the same processor."""
ANY_MACHINE = 5.0
"""Largest factor between two machines."""
AMONG_PLANNERS = 2.0
"""Largest factor by which the machines may differ more for one planner than for the others."""
OVERLAP = 1.5
"""Largest factor between CPU time and wall time, as a multiple of what it is here."""


def usable(pairs: Sequence[Pair]) -> list[Pair]:
    """The pairs whose planning took long enough to compare."""
    return [pair for pair in pairs if _long_enough(pair)]


def clock_faults(pairs: Sequence[Pair]) -> Iterator[str]:
    """Yield what no machine explains; nothing for less than `LEAST` usable pairs."""
    found = usable(pairs)
    if len(found) < LEAST:
        return
    ratios = np.array([_ratio(pair) for pair in found])
    middle = float(np.median(ratios))
    same = {_processor(stored.machine) for stored, _ in found} == {_processor(machine())}
    if middle > (SAME_MACHINE if same else ANY_MACHINE):
        whose = "the same processor" if same else "this processor"
        yield f"planning takes {middle:.1f} times the CPU time on {whose} (median of {len(found)} runs)"
    by_planner: dict[str, list[int]] = defaultdict(list)
    for index, (stored, _) in enumerate(found):
        by_planner[_planner(stored.record["config"])].append(index)
    for planner, mine in by_planner.items():
        others = np.delete(ratios, mine)
        if len(mine) < LEAST or len(others) < LEAST:
            continue
        factor = float(np.median(ratios[mine]) / np.median(others))
        if factor > AMONG_PLANNERS:
            yield f"{planner} is {factor:.1f} times faster than here, compared with the other planners"
    overlaps = [[_overlap(record) for record in (stored.record, again)] for stored, again in found]
    claimed, here = np.median(np.array(overlaps), axis=0)
    if claimed > OVERLAP * max(1.0, float(here)):
        yield f"planning has {claimed:.1f} times as much CPU time as wall time, here {here:.1f} times"


def _long_enough(pair: Pair) -> bool:
    stored, again = pair
    mine, theirs = _timing(again), _timing(stored.record)
    keys = ("planning_s", "planning_cpu_s")
    numbers = all(isinstance(timing.get(key), int | float) for timing in (mine, theirs) for key in keys)
    return numbers and max(mine["planning_cpu_s"], theirs["planning_cpu_s"]) >= SHORTEST_S


def _ratio(pair: Pair) -> float:
    stored, again = pair
    return float(_timing(again)["planning_cpu_s"]) / max(float(_timing(stored.record)["planning_cpu_s"]), 1e-9)


def _overlap(record: Any) -> float:
    timing = _timing(record)
    return float(timing["planning_cpu_s"]) / max(float(timing["planning_s"]), 1e-9)


def _timing(record: Any) -> dict[str, Any]:
    return record.get("timing") or {}


def _processor(facts: Any) -> str:
    return str(facts.get("processor"))


def _planner(config: Any) -> str:
    block = config.get("planner")
    return str(block.get("plugin")) if isinstance(block, dict) else str(block)
