"""Checks scenarios and recordings in a worker process: instances are built again, and plans and metrics recomputed."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.execution.routes import start_poses
from mrpbench_core.engine.json_values import jsonable
from mrpbench_core.engine.pipeline import router_of
from mrpbench_core.engine.stage import RunEnded
from mrpbench_core.engine.stages.assign import assign, tasks_of_plan
from mrpbench_core.engine.stages.claims import claims_of
from mrpbench_core.engine.stages.judge import Promises, judge
from mrpbench_core.engine.stages.measure import measure_recording
from mrpbench_core.engine.stages.prepare import RunInstance, build_run_instance
from mrpbench_core.engine.stages.problem_building import build_problem
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.plugins.local import refuse_local
from mrpbench_core.store.recording import Recording

T = TypeVar("T")
STEP = 0.05
"""Metres that the engine lets a robot move in a period in addition to twice its largest speed."""


def scenario_ids(parcels: list[dict[str, Any]], trusted: bool) -> list[str | None]:
    """Return the id of the scenario that each configuration draws; None where it draws none."""
    if not trusted:
        refuse_local()
    return [_scenario_id(parcel) for parcel in parcels]


def recording_faults(parcel: dict[str, Any], record: dict[str, Any], file: str, trusted: bool) -> list[str]:
    """Return how a recording contradicts its record, its configuration, or the rules of the engine."""
    if not trusted:
        refuse_local()
    try:
        recording = Recording(Path(file))
        try:
            return list(_faults(unpack(parcel), record, recording))
        finally:
            recording.close()
    except (InputError, InputErrors) as error:
        return [str(error).replace(file, Path(file).name)]
    except RunEnded as ended:
        return [f"there is a recording, but the run ends before its planning: {ended}"]


def _scenario_id(parcel: dict[str, Any]) -> str | None:
    try:
        return build_run_instance(unpack(parcel), _ignore).scenario.id
    except (InputError, InputErrors, RunEnded):
        return None


def _ignore(*_: Any) -> None: ...


def _faults(config: RunConfig, record: Mapping[str, Any], recording: Recording) -> Iterator[str]:
    first = recording.first_context()
    if first.run_id != record["run_id"]:
        yield "is the recording of another run"
        return
    instance = build_run_instance(config, _ignore)
    for name in ("world", "fleet", "scenario"):
        if _form(getattr(instance, name)) != _form(getattr(first, name)):
            yield f"its {name} is not the one of the configuration"
            return
    yield from _plan_faults(config, instance, first, record)
    yield from _motion_faults(config, record, recording, first)
    yield from _metric_faults(config, record, recording)


def _plan_faults(
    config: RunConfig, instance: RunInstance, first: RunContext, record: Mapping[str, Any]
) -> Iterator[str]:
    assigned = None if config.planner.assigns else assign(config, instance, _ignore, {})
    problem = build_problem(instance, assigned, config.assigner, Feature.GOAL_SETS in config.planner.supports)
    if _form(problem) != _form(first.problem):
        yield "its problem is not the one of the configuration"
        return
    promises = Promises.of(config.planner)
    result, fault = judge(promises, problem, first.result)
    if fault is not None or result.plan is None:
        yield f"its plan {fault or 'is missing'}"
        return
    if jsonable(claims_of(promises, problem, result)) != (record.get("plan") or {}):
        yield "its plan has another problem, cost or bound than the record says"
    if assigned is None:
        assigned = tasks_of_plan(instance, problem, result.plan)
    if first.assigned != assigned:
        yield "its tasks are not those of its assignment"
    routes = router_of(config, instance, assigned, problem)(result.plan)
    if [_form(route) for route in routes] != [_form(route) for route in first.routes]:
        yield "its routes do not follow from its plan"


def _motion_faults(
    config: RunConfig, record: Mapping[str, Any], recording: Recording, first: RunContext
) -> Iterator[str]:
    if "time" not in recording.channels:  # the dispatcher refused the plan
        if record["status"] != RunStatus.EXECUTION_ABORTED:
            yield f"has the status {record['status']}, and nothing was recorded"
        return
    time, truth = recording.channel("time"), recording.channel("truth")
    period = 1 / config.control_rate
    step = max(1, round(1 / (config.recording.rate * period))) * period
    spans = np.diff(time)
    if (
        not len(time)
        or time[0] != 0
        or (len(spans) and (spans.max() > step + 1e-6 or (spans[:-1] < step - 1e-6).any()))
    ):
        yield "its samples are not those of its rate: some are missing"
    starts = start_poses(first.routes, first.scenario.start[:, 2])
    if len(truth) and np.abs(truth[0] - starts)[:, :2].max(initial=0) > STEP:
        yield "its robots do not begin at their starts"
    limits = np.array([robot.max_speed for robot in first.fleet.robots])
    moved = np.hypot(*np.moveaxis(np.diff(truth[..., :2], axis=0), -1, 0))
    allowed = 2 * limits * spans[:, None] + STEP * np.ceil(spans[:, None] / period - 1e-6)
    if (moved > allowed + 1e-6).any():
        yield "a robot moves further than it can"
    timing = record.get("timing") or {}
    wall, factor = timing.get("execution_wall_s"), timing.get("real_time_factor")
    if wall is not None and factor is not None and len(time) and abs(wall * factor - time[-1]) > period + 1e-6:
        yield "its wall time and real-time factor do not give the simulated time of the recording"
    if record["status"] == RunStatus.SUCCEEDED:
        routes = recording.context().routes
        ends = np.array([route.waypoint[-1, :2] for route in routes])
        lasts = np.array([route.last_move for route in routes])
        away = np.hypot(*np.moveaxis(truth[-1, :, :2] - ends, -1, 0)) if len(truth) else np.array([np.inf])
        if (away > config.goal_tolerance + STEP).any() or (recording.channel("reached")[-1] < lasts).any():
            yield "has the status succeeded, and a robot is not at its goal at the end"


def _metric_faults(config: RunConfig, record: Mapping[str, Any], recording: Recording) -> Iterator[str]:
    values, reasons = measure_recording(config.metrics, recording.file)
    claimed = record.get("metrics") or {}
    for name, value in jsonable(values).items():
        if name not in claimed or claimed[name] != value:
            yield f"{name} is not what the recording gives"
    if jsonable(reasons) != (record.get("unmeasured") or {}):
        yield "other values cannot be measured than the record says"


def _form(value: T) -> str:
    """A value of the model as it is stored, as text: parts that recordings leave out do not count."""
    arrays: dict[str, NDArray[Any]] = {}

    def keep(array: NDArray[Any]) -> str:
        content = np.ascontiguousarray(array)
        key = hashlib.sha256(f"{array.dtype} {array.shape}".encode() + content.tobytes()).hexdigest()
        arrays[key] = array
        return key

    stored = json.loads(json.dumps(encode(value, keep)))
    return json.dumps(encode(decode(stored, type(value), arrays.__getitem__), keep), sort_keys=True)
