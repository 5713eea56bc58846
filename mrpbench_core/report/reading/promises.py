"""Finds planners whose claims other runs of the same problem refute: bounds, optimality and proofs that no plan exists.

A plan that the engine has found valid and without conflicts is the evidence; no planner is believed.
"""

import math
from array import array
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int

SLACK = 1e-6
"""Relative error of bounds that are computed in floating point."""
_NUMBERS = ("cost", "lower_bound", "factor")


class Claims:
    """What the planners of runs claim: the entry `plan` of their records, as columns."""

    def __init__(self) -> None:
        self._problems: dict[str, int] = {}
        self._columns = {name: array("d") for name in _NUMBERS}
        self._places = {name: array("q") for name in ("setting", "problem")}
        self._flags = {name: array("b") for name in ("assigns", "unsolvable")}
        self._empty: list[tuple[array[Any], Any]] = [
            *((column, -1) for column in self._places.values()),
            *((column, math.nan) for column in self._columns.values()),
            *((column, False) for column in self._flags.values()),
        ]

    def add(self, record: Mapping[str, Any]) -> None:
        """Add the claims of the next run, if its record has any."""
        claims = record.get("plan")
        if not claims:
            for column, empty in self._empty:
                column.append(empty)
            return
        where = {"setting": (record.get("scenario_id"), claims.get("setting")), "problem": claims.get("problem")}
        for name, column in self._places.items():
            known = claims.get(name) is not None
            column.append(self._problems.setdefault(repr(where[name]), len(self._problems)) if known else -1)
        for name, numbers in self._columns.items():
            value = claims.get(name)
            numbers.append(math.nan if value is None else float(value))
        for name, flags in self._flags.items():
            flags.append(bool(claims.get(name)))

    def broken(self, run_id: Sequence[str]) -> dict[int, str]:
        """Return in a sentence what each run that breaks a promise claims, and which run refutes it, by index."""
        cost, bound, factor = (np.array(self._columns[name], float) for name in _NUMBERS)
        assigns, unsolvable = (np.array(self._flags[name], bool) for name in ("assigns", "unsolvable"))
        places = {name: np.array(column, np.int64) for name, column in self._places.items()}
        # A planner that also assigns could have returned any plan for these robots and tasks.
        same = _cheapest(places["problem"], cost)
        any_assignment = _cheapest(places["setting"], cost)
        witness = np.where(assigns, any_assignment, same)
        least = np.where(witness >= 0, cost[witness], np.inf) if len(cost) else cost
        limit = np.where(np.isfinite(least), factor * least, np.inf)
        faults = {}
        for index in np.flatnonzero((cost > limit * (1 + SLACK)) | (bound > least * (1 + SLACK))).tolist():
            other = f"run {run_id[witness[index]][:12]} has a valid plan of cost {least[index]:g}"
            if bound[index] > least[index] * (1 + SLACK):
                faults[index] = f"claims the lower bound {bound[index]:g}, but {other}"
            else:
                allowed = f"at most {factor[index]:g} times the least cost"
                promised = "the least cost" if factor[index] == 1 else allowed
                faults[index] = f"promises {promised} and costs {cost[index]:g}, but {other}"
        for index in np.flatnonzero(unsolvable & np.isfinite(least)).tolist():
            other = f"run {run_id[witness[index]][:12]} has a valid plan of cost {least[index]:g}"
            faults[index] = f"claims a proof that no plan exists, but {other}"
        return faults


def _cheapest(place: Int, cost: Float) -> Int:
    """For each run, the index of the cheapest plan of its problem; -1 if no run has one."""
    best = np.full(len(place), -1)
    having = np.flatnonzero(np.isfinite(cost) & (place >= 0))
    order = having[np.lexsort((having, cost[having], place[having]))]
    known, first = np.unique(place[order], return_index=True)
    if len(known):
        at = np.minimum(np.searchsorted(known, place), len(known) - 1)
        best = np.where(known[at] == place, order[first[at]], -1)
    return best
