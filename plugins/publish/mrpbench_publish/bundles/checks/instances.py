"""Checks scenarios and recordings in worker processes: instances are made again, and the referee judges again.

As when the run was done, what judges it imports none of the components that are judged.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mrpbench_core.api.metric import Metric
from mrpbench_core.config.structure import Structure
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.json_values import jsonable
from mrpbench_core.engine.prepare.make_instance import build_run_instance, make_instance
from mrpbench_core.engine.prepare.question import SETTINGS, Question
from mrpbench_core.engine.stage import RunEnded, ignore
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.local import refuse_local
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.measuring import measure
from mrpbench_core.referee.verdict import Failure, finished_run, judge
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.recording import Recording


def scenario_ids(parcels: list[dict[str, Any]], trusted: bool) -> list[str | None]:
    """Return the id of the scenario that each configuration draws; None where it draws none."""
    if not trusted:
        refuse_local()
    return [_scenario_id(parcel) for parcel in parcels]


def recording_faults(
    parcel: dict[str, Any], facts: dict[str, Any], record: dict[str, Any], file: str, trusted: bool
) -> list[str]:
    """Return how a record contradicts its recording, or the recording its configuration.

    Args:
        parcel: the configuration.
        facts: see `mrpbench_core.engine.asking.facts_of_run`.
        record: of the run.
        file: its recording.
        trusted: local code may be executed.
    """
    return _checked(lambda recording: _faults(parcel, facts, record, recording), file, trusted)


def measured_faults(
    parcel: dict[str, Any], facts: dict[str, Any], number: int, record: dict[str, Any], file: str, trusted: bool
) -> list[str]:
    """Return how a record contradicts a metric of others, by its number; see `recording_faults`."""
    asked = Asked.of_message({**facts["asked"], "run_id": record["run_id"]})

    def faults(recording: Recording) -> Iterator[str]:
        return _differences(record, *measure(_metrics(parcel, [number]), finished_run(recording, asked)))

    return _checked(faults, file, trusted)


def _checked(faults: Callable[[Recording], Iterator[str]], file: str, trusted: bool) -> list[str]:
    if not trusted:
        refuse_local()
    try:
        with closing(Recording(Path(file))) as recording:
            return list(faults(recording))
    except (InputError, InputErrors) as error:
        return [str(error).replace(file, Path(file).name)]
    except RunEnded as ended:
        return [f"there is a recording, but the run ends before its planning: {ended}"]


def _settings(parcel: Mapping[str, Any], config: Mapping[str, Any]) -> dict[str, Any]:
    return Structure(Path(parcel["folder"]), parcel["sources"]).settings(config)


def _metrics(parcel: Mapping[str, Any], numbers: Iterable[int]) -> Mapping[str, Metric]:
    chosen = [parcel["config"]["metrics"][number] for number in numbers]
    metrics: Mapping[str, Metric] = _settings(parcel, {"metrics": chosen})["metrics"]
    return metrics


def _scenario_id(parcel: dict[str, Any]) -> str | None:
    try:
        return build_run_instance(Question.of(unpack(parcel)), ignore).scenario.id
    except (InputError, InputErrors, RunEnded):
        return None


def _faults(
    parcel: Mapping[str, Any], facts: Mapping[str, Any], record: Mapping[str, Any], recording: Recording
) -> Iterator[str]:
    if recording.recorded_run().run_id != record["run_id"]:
        yield "is the recording of another run"
        return
    question = Question(**_settings(parcel, {name: parcel["config"][name] for name in SETTINGS}), **facts["question"])
    with TemporaryDirectory(prefix="mrpbench-") as name:
        instances = InstanceFolder(Path(name))
        made = instances.write(make_instance(question, ignore, {}))
        recorded = recording.instance_name or instances.write(recording.instance())
    if made != recorded:
        if record["status"] != RunStatus.CONTRACT_BROKEN:
            yield "its world, robots, tasks or goals are not those of the configuration"
        return
    asked = Asked.of_message({**facts["asked"], "run_id": record["run_id"]})
    of_others = {metric["number"] for metric in facts["others_metrics"]}
    ours = [number for number in range(len(parcel["config"]["metrics"])) if number not in of_others]
    source = None if asked.task_seed is None else question.tasks
    verdict = judge(asked, recording, recording.instance_name, _metrics(parcel, ours), _said(record), source)
    status = RunStatus.SUCCEEDED if verdict.failure is None else verdict.failure.status
    if status != record["status"]:
        why = "" if verdict.failure is None else f": {verdict.failure.message}"
        yield f"has the status {record['status']}, and its recording shows {status}{why}"
    if jsonable(verdict.plan) != (record.get("plan") or {}):
        yield "its plan has another problem, cost or bound than the record says"
    if verdict.metrics or verdict.unmeasured:
        yield from _differences(record, verdict.metrics, verdict.unmeasured)
    yield from _times(record, recording)


def _differences(record: Mapping[str, Any], metrics: Mapping[str, Any], unmeasured: Mapping[str, str]) -> Iterator[str]:
    """Yield the values that a record has otherwise than its recording gives them."""
    claimed, reasons = record.get("metrics") or {}, record.get("unmeasured") or {}
    for name, value in jsonable(metrics).items():
        if name not in claimed or claimed[name] != value:
            yield f"{name} is not what the recording gives"
    names = {part for name in metrics for part in (name, name.partition(".")[0])}
    if jsonable(unmeasured).keys() != reasons.keys() & names:
        yield "other values cannot be measured than the record says"


def _said(record: Mapping[str, Any]) -> Failure | None:
    error = record.get("error")
    if not error:
        return None
    return Failure(status=RunStatus(record["status"]), stage=Stage(error["stage"]), message=error["message"])


def _times(record: Mapping[str, Any], recording: Recording) -> Iterator[str]:
    """The times of a record that its recording contradicts."""
    timing = record.get("timing") or {}
    wall, factor = timing.get("execution_wall_s"), timing.get("real_time_factor")
    if wall is None or factor is None or "time" not in recording.channels:
        return
    time = recording.channel("time")
    if len(time) and abs(wall * factor - time[-1]) > recording.recorded_run().period + 1e-6:
        yield "its wall time and real-time factor do not give the simulated time of the recording"
