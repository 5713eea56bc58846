"""Tells whether a run had a plan, and gives the planning time that counts if it had none."""

from collections.abc import Mapping
from typing import Any

from mrpbench_core.model.runs.status import AFTER_PLANNING, PLANNED

PENALTY = 2.0
"""Factor of PAR2: a run without a plan counts as this many times the planning limit."""


def has_plan(record: Mapping[str, Any]) -> bool | None:
    """Tell whether a run had a valid plan, however the run ended; None of recordings of others that hold no plan."""
    if not (record.get("analysis") or {}).get("planned", True):
        return None
    stage = (record.get("error") or {}).get("stage")
    return record["status"] in PLANNED or stage in AFTER_PLANNING
