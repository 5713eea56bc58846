"""Checks scenarios and recordings in a worker process: instances are made again, and the referee judges again."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.asking import asked_of
from mrpbench_core.engine.json_values import jsonable
from mrpbench_core.engine.prepare.make_instance import build_run_instance, make_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.stage import RunEnded, ignore
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.local import refuse_local
from mrpbench_core.referee.verdict import Ending, judge
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.recording import Recording


def scenario_ids(parcels: list[dict[str, Any]], trusted: bool) -> list[str | None]:
    """Return the id of the scenario that each configuration draws; None where it draws none."""
    if not trusted:
        refuse_local()
    return [_scenario_id(parcel) for parcel in parcels]


def recording_faults(parcel: dict[str, Any], record: dict[str, Any], file: str, trusted: bool) -> list[str]:
    """Return how a record contradicts its recording, or the recording its configuration."""
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
        return build_run_instance(Question.of(unpack(parcel)), ignore).scenario.id
    except (InputError, InputErrors, RunEnded):
        return None


def _faults(config: RunConfig, record: Mapping[str, Any], recording: Recording) -> Iterator[str]:
    if recording.recorded_run().run_id != record["run_id"]:
        yield "is the recording of another run"
        return
    with TemporaryDirectory(prefix="mrpbench-") as name:
        instances = InstanceFolder(Path(name))
        made = instances.write(make_instance(Question.of(config), ignore, {}))
        recorded = recording.instance_name or instances.write(recording.instance())
    if made != recorded:
        yield "its world, robots, tasks or goals are not those of the configuration"
        return
    verdict = judge(asked_of(config, record["run_id"]), recording, config.metrics, _said(record))
    status = RunStatus.SUCCEEDED if verdict.ending is None else verdict.ending.status
    if status != record["status"]:
        why = "" if verdict.ending is None else f": {verdict.ending.message}"
        yield f"has the status {record['status']}, and its recording shows {status}{why}"
    if jsonable(verdict.plan) != (record.get("plan") or {}):
        yield "its plan has another problem, cost or bound than the record says"
    claimed = record.get("metrics") or {}
    for name, value in jsonable(verdict.metrics).items():
        if name not in claimed or claimed[name] != value:
            yield f"{name} is not what the recording gives"
    if jsonable(verdict.unmeasured) != (record.get("unmeasured") or {}):
        yield "other values cannot be measured than the record says"
    yield from _times(record, recording)


def _said(record: Mapping[str, Any]) -> Ending | None:
    error = record.get("error")
    if not error:
        return None
    return Ending(status=RunStatus(record["status"]), stage=Stage(error["stage"]), message=error["message"])


def _times(record: Mapping[str, Any], recording: Recording) -> Iterator[str]:
    """The times of a record that its recording contradicts."""
    timing = record.get("timing") or {}
    wall, factor = timing.get("execution_wall_s"), timing.get("real_time_factor")
    if wall is None or factor is None or "time" not in recording.channels:
        return
    time = recording.channel("time")
    if len(time) and abs(wall * factor - time[-1]) > recording.recorded_run().period + 1e-6:
        yield "its wall time and real-time factor do not give the simulated time of the recording"
