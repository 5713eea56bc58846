"""Costs of a plan and the effort of the search. Wall time is not a metric; the record's `timing` holds it."""

import math
from collections.abc import Mapping
from functools import partial
from typing import ClassVar

import attrs
import numpy as np

from mrpbench_core.api import Column, Metric, Value
from mrpbench_core.model.planning.plan import Plan, PlanStatus
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_metrics_standard.original import SOURCE

STERN = "Stern et al., Multi-Agent Pathfinding: Definitions, Variants, and Benchmarks, SoCS 2019"
_column = partial(Column, stage="planning")


@attrs.frozen(kw_only=True)
class Planning(Metric):
    """Measures the first plan of a run; its costs are null where tasks come over time, which it does not know."""

    columns: ClassVar[tuple[Column, ...]] = (
        _column("solved", "", "higher", "the planner found a plan that keeps its promises, within its limits"),
        _column(
            "sum_of_costs",
            "s",
            "lower",
            "sum over robots of the time at which each arrives at its goal for the last time",
            STERN,
            primary=True,
            drawn="profile",
            answers="duration",
            threshold=1.0,
            threshold_share=0.01,
        ),
        _column(
            "makespan",
            "s",
            "lower",
            "time at which the last robot arrives at its goal",
            STERN,
            primary=True,
            answers="duration",
            threshold=1.0,
            threshold_share=0.02,
        ),
        _column("sum_of_costs_ticks", "", "lower", "sum_of_costs in ticks of the roadmap", STERN),
        _column("makespan_ticks", "", "lower", "makespan in ticks of the roadmap", STERN),
        _column("lower_bound_ticks", "", "neither", "lower bound on sum_of_costs_ticks that the planner proved"),
        _column(
            "suboptimality", "", "lower", "sum_of_costs_ticks / lower_bound_ticks: an upper bound on the true ratio"
        ),
        _column("conflicts", "", "lower", "pairs of robots that conflict in the plan, counted by the validator", STERN),
        _column("expansions", "", "lower", "search nodes expanded, as the planner counts them"),
        _column("generated", "", "neither", "search nodes generated, as the planner counts them"),
        _column(
            "low_level_expansions", "", "lower", "nodes expanded in single-robot searches, as the planner counts them"
        ),
        _column("moves", "", "lower", "moves along edges, without waits (sum of fuel)", STERN),
        _column("distance_m", "m", "lower", "length of all planned moves"),
        _column(
            "mrp_bench.cost",
            "",
            "lower",
            "sum over robots of the number of states in the schedule: arrival tick + 1",
            SOURCE,
        ),
        _column(
            "mrp_bench.makespan",
            "",
            "lower",
            "largest number of states in one robot's schedule: arrival tick + 1",
            SOURCE,
        ),
    )

    def measure(self, run: FinishedRun) -> Mapping[str, Value]:
        """Return all columns; without a plan, `solved` is false and the rest null."""
        result, roadmap = run.context.result, run.context.problem.roadmap
        solved = result.plan is not None and result.status == PlanStatus.SOLVED
        values: dict[str, Value] = {column.name: None for column in self.columns} | {"solved": solved}
        if result.plan is None:
            return values
        if not run.has("task_event"):
            values |= _costs(result.plan, roadmap)
        for name in ("conflicts", "expansions", "generated", "low_level_expansions"):
            values[name] = _finite(result.statistics.get(name))
        bound = _finite(result.lower_bound)
        values["lower_bound_ticks"] = bound
        if bound is not None and values["sum_of_costs"] is not None:
            values["suboptimality"] = _ratio(result.plan.sum_of_costs, bound)
        return values


def _costs(plan: Plan, roadmap: Roadmap) -> dict[str, Value]:
    arrivals = [path.arrival for path in plan.paths]
    total, latest = sum(arrivals), max(arrivals, default=0)
    edges = np.concatenate([path.edge[path.edge >= 0] for path in plan.paths] or [np.empty(0, np.int32)])
    span = np.diff(roadmap.position[roadmap.edges[edges]], axis=1)
    return {
        "sum_of_costs": total * roadmap.tick,
        "makespan": latest * roadmap.tick,
        "sum_of_costs_ticks": total,
        "makespan_ticks": latest,
        "moves": len(edges),
        "distance_m": float(np.hypot(span[..., 0], span[..., 1]).sum()),
        "mrp_bench.cost": total + len(arrivals),
        "mrp_bench.makespan": latest + 1 if arrivals else 0,
    }


def _finite(value: float | None) -> float | int | None:
    """None for a value that is missing or not finite; an int for a whole number."""
    if value is None or not math.isfinite(value):
        return None
    return int(value) if value == int(value) else value


def _ratio(cost: int, bound: float) -> float | None:
    """1 for a plan in which no robot moves; None where the planner proved no bound above 0."""
    if cost == bound:
        return 1.0
    return cost / bound if bound > 0 else None
