"""Checks each record by itself, and the records against each other, without the code that made them."""

import json
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from mrpbench_core.engine.drive.plan import LATE_S
from mrpbench_core.model.runs.status import PLANNED, RunStatus, Stage
from mrpbench_publish.bundles.opened import Opened, Stored
from mrpbench_publish.bundles.verdict import Fault

_STAGES = {
    RunStatus.GOALS_MISSED: {Stage.EXECUTION},
    RunStatus.EXECUTION_ABORTED: {Stage.EXECUTION},
    RunStatus.PLAN_TIMEOUT: {Stage.PLANNING},
    RunStatus.PLAN_UNSOLVABLE: {Stage.PLANNING},
    RunStatus.PLAN_NOT_FOUND: {Stage.PLANNING},
    RunStatus.PLAN_INVALID: {Stage.PLANNING},
    RunStatus.SKIPPED: {Stage.PLANNING},
    RunStatus.SCENARIO_INFEASIBLE: {Stage.SCENARIO},
    RunStatus.ASSIGNMENT_FAILED: {Stage.ASSIGNMENT},
}
"""The stages in which runs end with a status; any for the others."""
_MADE_LATER = {RunStatus.PROMISE_BROKEN, RunStatus.UNKNOWN}
CPU_MARGIN_S = 0.1


def record_faults(bundle: Opened) -> Iterator[Fault | str]:
    """Yield damaged and doubled records, and those whose keys contradict each other."""
    yield from (str(error.message) + f" (line {error.line})" for error in bundle.results.damaged)
    for shard in bundle.results.folder.shards():
        content = shard.read_bytes()
        if content and not content.endswith(b"\n"):
            yield shard.name, "ends in the middle of a record"
    attempts: set[tuple[str, int]] = set()
    for stored in bundle.records():
        record = stored.record
        attempt = record.get("attempt", 1)
        if (stored.run_id, attempt) in attempts:
            yield stored.run_id, f"has two records of attempt {attempt}"
        attempts.add((stored.run_id, attempt))
        for key in ("seed", "repeat"):
            if record.get(key) != record["config"].get(key):
                yield stored.run_id, f"its {key} is not the one of its configuration"
        if "analysis" in record:
            yield stored.run_id, "is a measurement of a recording of others"


def status_faults(stored: Stored, columns: Mapping[str, Any]) -> Iterator[str]:
    """Yield what contradicts the status of a record.

    Args:
        stored: the record.
        columns: names of all columns that its invocation declares.
    """
    record = stored.record
    status, config = RunStatus(record["status"]), record["config"]
    error = record.get("error") or {}
    if status in _MADE_LATER:
        yield f"no run ends with the status {status}"
    if status == RunStatus.SUCCEEDED and error:
        yield f"has the status {status} and an error"
    if status != RunStatus.SUCCEEDED and not (error.get("stage") and error.get("message")):
        yield f"has the status {status} and no error"
    if error and error.get("stage") not in _STAGES.get(status, {error.get("stage")}):
        yield f"has the status {status}, which a run cannot get in the stage {error.get('stage')}"
    metrics, timing = record.get("metrics") or {}, record.get("timing") or {}
    simulated = config.get("simulator") not in (None, "none")
    if status in PLANNED:
        if metrics.keys() != columns.keys():
            yield "its metrics are not the columns that its invocation declares"
        if "planning_s" not in timing:
            yield "has a plan and no planning time"
        if simulated and status != RunStatus.EXECUTION_ABORTED and "execution_wall_s" not in timing:
            yield "was executed and has no time of the execution"
    elif metrics.keys() - columns.keys():
        yield "has metrics that its invocation does not declare"
    if status in PLANNED and (fault := _recording_fault(stored, status)):
        yield fault
    claims = record.get("plan") or {}
    if claims and claims.get("unsolvable", False) != (status == RunStatus.PLAN_UNSOLVABLE):
        yield "its status and what it says of its plan differ about whether a plan exists"
    if claims.get("cost") is not None and status not in PLANNED and error.get("stage") == Stage.PLANNING:
        yield f"has the status {status} and the cost of a plan"


def timing_faults(stored: Stored) -> Iterator[str]:
    """Yield times that no clock can have measured."""
    record = stored.record
    timing, status = record.get("timing") or {}, RunStatus(record["status"])
    times = {key: value for key, value in timing.items() if key.endswith(("_s", "_bytes", "_factor"))}
    if any(not isinstance(value, int | float) or not math.isfinite(value) or value < 0 for value in times.values()):
        yield "has a time or size that is not a number of 0 or more"
        return
    wall, cpu = times.get("planning_s"), times.get("planning_cpu_s")
    cores = stored.machine.get("cores")
    if wall is not None and cpu is not None and isinstance(cores, int) and cpu > cores * wall + CPU_MARGIN_S:
        yield "its planning took more CPU time than its cores have in its wall time"
    limit = stored.block("limits").get("planning")
    if wall is not None and isinstance(limit, int | float) and status in PLANNED and wall > limit + LATE_S:
        yield "has a plan that came after the limit"
    if status == RunStatus.PLAN_TIMEOUT and wall is not None and not timing.get("clock_bound"):
        yield "is a timeout that no clock decided"
    yield from _history_faults(timing.get("planning_history"), wall)


def scenario_faults(records: Iterable[Stored]) -> Iterator[Fault]:
    """Yield runs that do not have the scenario of other runs whose world, roadmap, fleet and seed are the same."""
    known: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for stored in records:
        scenario = stored.record.get("scenario_id")
        if scenario is not None:
            known[scenario_key(stored.record["config"])][scenario].append(stored.run_id)
    for scenarios in known.values():
        usual = max(scenarios.values(), key=len)
        for runs in scenarios.values():
            if runs is not usual:
                yield from ((run, "has another scenario than other runs of its world, robots and seed") for run in runs)


def scenario_key(config: Mapping[str, Any]) -> str:
    """The part of a canonical configuration that determines the scenario, as text."""
    parts = ("world", "roadmap", "scenario", "fleet", "seed")
    return json.dumps([config.get(part) for part in parts], sort_keys=True)


def _recording_fault(stored: Stored, status: RunStatus) -> str | None:
    keep = stored.block("recording").get("keep")
    wanted = keep == "all" or (keep == "failed" and status != RunStatus.SUCCEEDED)
    if wanted == (stored.recording is not None):
        return None
    return "names no recording, and one was to be kept" if wanted else "names a recording, and none was to be kept"


def _history_faults(history: Any, wall: Any) -> Iterator[str]:
    if history is None:
        return
    try:
        seconds = [row[0] for row in history]
        costs = [row[1] for row in history if row[1] is not None]
        late = isinstance(wall, int | float) and seconds and seconds[-1] > wall + LATE_S
        if late or seconds != sorted(seconds) or costs != sorted(costs, reverse=True):
            yield "its anytime curve goes back in time, gets worse, or is longer than the planning"
    except (TypeError, IndexError):
        yield "its anytime curve is not a list of seconds, costs and bounds"
