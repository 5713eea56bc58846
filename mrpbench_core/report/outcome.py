"""What a status says about the method: the one place for which runs count, and which planned."""

from collections.abc import Mapping
from typing import Any

LEFT_OUT = frozenset({"scenario_infeasible", "skipped"})
"""Statuses that say nothing about the method: they leave every denominator and are shown as such."""
PLANNED = frozenset({"succeeded", "goals_missed", "execution_aborted"})
_AFTER_PLANNING = frozenset({"execution", "export", "metrics"})
"""Stages in which a run that was ended had a plan."""
PENALTY = 2.0
"""PAR2: without a plan, planning counts as this many times its limit."""


def has_plan(record: Mapping[str, Any]) -> bool:
    """Whether a run had a plan that keeps its planner's promises, whatever came of it."""
    stage = (record.get("error") or {}).get("stage")
    return record["status"] in PLANNED or stage in _AFTER_PLANNING
