"""Compares records with those of the same runs, done again here."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.study.options import StudyOptions
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.study import run_study
from mrpbench_core.model.runs.status import FAILED, RunStatus
from mrpbench_publish.bundles.checks.study import Asked
from mrpbench_publish.bundles.opened import Stored
from mrpbench_publish.bundles.verdict import Fault

Pair = tuple[Stored, dict[str, Any]]
"""A record of the bundle, and the one that was made here."""
_OF_THE_MACHINE = FAILED - {RunStatus.PLAN_INVALID, RunStatus.ASSIGNMENT_FAILED, RunStatus.CONTRACT_BROKEN}
"""Statuses that may depend on the machine, whose messages are not compared."""
_COMPARED = ("scenario_id", "status", "metrics", "unmeasured", "error", "unarrived", "plan", "reassigned", "true_poses")
_EARLY = 0.2
"""Share of the planning limit: a planner that ends here before it is not one whose search a clock decides."""


def repeat(
    asked: Asked, chosen: Sequence[Stored], folder: Path, slots: str, workers: int, progress: StudyProgress
) -> list[Pair]:
    """Do runs again in a new results folder.

    Raises:
        InputError: the folder cannot be used.
    """
    pairs: list[Pair] = []
    for number, (name, expected) in enumerate(sorted(asked.by_name.items())):
        mine = {stored.run_id: stored for stored in chosen if stored.shard == name}
        points = tuple(point for point in expected.study.runs if point.run_id in mine and not point.live)
        if not points:
            continue
        options = StudyOptions(out=folder / str(number), workers=workers, progress=progress)
        done = run_study(attrs.evolve(expected.study, runs=points), options, slots)
        pairs += [(mine[record["run_id"]], record) for record in done.results]
    return pairs


def is_comparable(pair: Pair) -> bool:
    """Tell whether both runs must be equal outside their timing."""
    stored, again = pair
    return not any((record.get("timing") or {}).get("clock_bound") for record in (stored.record, again))


def same_platform(stored: Stored) -> bool:
    """Tell whether a record was made with the C library of this machine, on which the last digits depend."""
    return bool(stored.machine.get("libc") == machine()["libc"])


def repetition_faults(pairs: Sequence[Pair]) -> Iterator[Fault]:
    """Yield runs that end differently here."""
    for stored, again in pairs:
        yield from ((stored.run_id, fault) for fault in _differences(stored, again))


def _differences(stored: Stored, again: Mapping[str, Any]) -> Iterator[str]:
    record = stored.record
    if not is_comparable((stored, dict(again))):
        yield from _clock_differences(stored, again)
        return
    statuses = {record["status"], again["status"]}
    if statuses & _OF_THE_MACHINE:
        if len(statuses) > 1:
            yield f"has the status {record['status']}, here {again['status']}"
        return
    for key in _COMPARED if same_platform(stored) else ("scenario_id", "plan"):
        claimed, repeated = record.get(key) or {}, again.get(key) or {}
        if claimed == repeated:
            continue
        if key == "metrics":
            names = sorted(name for name in {*claimed, *repeated} if claimed.get(name) != repeated.get(name))
            yield from (f"{name} differs when the run is repeated" for name in names)
        else:
            yield f"its {key} differs when the run is repeated" + (f": here {repeated}" if key == "status" else "")
    mine = next((line[:64] for line in again["provenance"]["files"] if "  recordings/" in line), None)
    if same_platform(stored) and stored.recording != mine:
        yield "its recording differs when the run is repeated"


def _clock_differences(stored: Stored, again: Mapping[str, Any]) -> Iterator[str]:
    """What a run may not claim although the clock decided its plan."""
    if stored.record.get("scenario_id") != again.get("scenario_id"):
        yield "its scenario_id differs when the run is repeated"
    here = again.get("timing") or {}
    seconds = stored.block("limits").get("planning")
    limit = seconds if isinstance(seconds, int | float) else 0.0
    if not here.get("clock_bound") and here.get("planning_s", limit) < _EARLY * limit:
        yield "says that the clock ended its planning, which ends by itself here, long before the limit"
