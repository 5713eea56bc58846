"""What is known of each column of numbers: unit, direction, meaning."""

from collections.abc import Iterable
from typing import Any

import attrs

from mrpbench_core.report.invocations import read_invocations
from mrpbench_core.report.outcome import PENALTY
from mrpbench_core.report.runs import PAR2
from mrpbench_core.store.results import Results

DIRECTIONS = {"lower": -1, "higher": 1}
MAIN = (
    "planning.sum_of_costs",
    "planning.makespan",
    "timing.planning_s",
    PAR2,
    "execution.duration_s",
    "execution.min_distance_m",
    "execution.time_blocked_s",
    "execution.robot_contacts",
)
"""Columns shown where no others are asked for and some run has them."""


@attrs.frozen
class Column:
    """What a number means."""

    name: str
    unit: str = ""
    better: str = "neither"
    text: str = ""

    @property
    def direction(self) -> int:
        """1 where more is better, -1 where less is, 0 where neither is known to be."""
        return DIRECTIONS.get(self.better, 0)

    @property
    def heading(self) -> str:
        """Name and unit."""
        return f"{self.name} [{self.unit}]" if self.unit and not self.name.endswith(f"_{self.unit}") else self.name


OUTCOME = (
    Column("succeeded", "", "higher", "share of the runs that planned and arrived, of all that count"),
    Column("planned", "", "higher", "share of the runs whose planner found a plan that keeps its promises"),
)
TIMING = (
    Column("timing.planning_s", "s", "lower", "wall time of the planner's call; runs with a plan only"),
    Column(PAR2, "s", "lower", f"the same, where a run without a plan counts {PENALTY:g} times its limit (PAR2)"),
    Column("timing.planning_cpu_s", "s", "lower", "CPU time of the planner's call; runs with a plan only"),
    Column("timing.planning_peak_bytes", "B", "lower", "memory that planning added; runs with a plan only"),
    Column("timing.real_time_factor", "", "higher", "simulated time over wall time of the execution"),
    Column("timing.clock_bound", "", "lower", "planning was ended by a clock"),
)


def read_columns(folders: Iterable[Results], names: Iterable[str]) -> dict[str, Column]:
    """What the folders' invocations say of these columns; merged folders may lack it, and units are then unknown."""
    told: dict[str, Any] = {}
    for invocation in read_invocations(folders):
        told |= invocation.get("columns") or {}
    fixed = {column.name: column for column in (*OUTCOME, *TIMING)}
    return {name: fixed.get(name) or _column(name, told.get(name)) for name in names}


def _column(name: str, told: Any) -> Column:
    if isinstance(told, dict):
        return Column(name, told.get("unit") or "", told.get("better") or "neither", told.get("description") or "")
    if name.startswith("timing."):
        unit = {"s": "s", "bytes": "B"}.get(name.rpartition("_")[2], "")
        return Column(name, unit, "lower" if unit else "neither")
    return Column(name)
