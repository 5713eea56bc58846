"""The steps of a run, each in a process of its own: prepare, drive, judge, and measure.

| step | modules of others in its process | gets | answers with |
|---|---|---|---|
| prepare | those of world, roadmap, scenario, tasks, assigner | settings | name of the instance |
| drive | all of the configuration | configuration, instance | what the process claims; writes the recording |
| judge | none, ever | instance, recording, claims | the record |
| measure | those of one metric | instance, recording | values |
"""

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.metric import Metric
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.unpacking import Unpacking
from mrpbench_core.engine.drive.drive import Claims, drive
from mrpbench_core.engine.json_values import jsonable
from mrpbench_core.engine.judging import Prepared, keep, record_of
from mrpbench_core.engine.prepare.fleet import build_fleet
from mrpbench_core.engine.prepare.question import SETTINGS, Question
from mrpbench_core.engine.processes.channel import Channel
from mrpbench_core.engine.run import ended_before, prepare
from mrpbench_core.engine.stage import RunEnded, RunInputs
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.plugins.provenance import title
from mrpbench_core.referee.asked import Asked
from mrpbench_core.referee.measuring import measure
from mrpbench_core.referee.verdict import Failure, finished_run
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

Job = Mapping[str, Any]
Answer = dict[str, Any]


@attrs.define(kw_only=True)
class State:
    """What the processes of a fork server begin with."""

    hooks: Hooks = attrs.field(factory=Hooks)
    unpack: Unpacking = attrs.field(factory=Unpacking)
    config: RunConfig | None = None
    """The configuration of the job, once it is known, to name the component that fails."""
    instances: InstanceFolder | None = None
    """The last folder of instances, with what of it is in memory."""
    instance: tuple[Path, Instance] | None = None
    """The instance that was read before the process was forked, and its file."""

    def folder(self, path: Path) -> InstanceFolder:
        """A folder of instances."""
        if self.instances is None or self.instances.path != path:
            self.instances = InstanceFolder(path)
        return self.instances

    def read(self, name: str) -> None:
        """Read the instance of a job for the process that is forked for it."""
        file = Path(name)
        with suppress(InputError):  # which the job finds, too
            if file.suffix and (self.instance is None or self.instance[0] != file):
                self.instance = file, self.folder(file.parent).read(file.stem)

    def instance_of(self, job: Job) -> Instance:
        """The instance of a job.

        Raises:
            InputError: it is not here, or it is damaged.
        """
        file = Path(job["instance_file"])
        if self.instance is not None and self.instance[0] == file:
            return self.instance[1]
        return self.folder(file.parent).read(file.stem)

    def question(self, job: Job) -> tuple[Question, bool]:
        """What an instance is made of, and whether its scenario gives each robot a goal."""
        settings = self.unpack.settings(job["parcel"], SETTINGS)
        return Question(**settings, **job["facts"]["question"]), bool(settings["scenario"].gives_goals)


def _prepare(job: Job, channel: Channel, state: State) -> Answer:
    """Make the instance of a run."""
    question, gives_goals = state.question(job)
    try:
        folder = state.folder(_paths(job).instances)
        prepared, _ = prepare(question, gives_goals, folder, _announcer(channel))
    except RunEnded as ended:
        return {"record": jsonable(ended_before(job["run_id"], ended).message())}
    return {"prepared": attrs.asdict(prepared)}


def _drive(job: Job, channel: Channel, state: State) -> Answer:
    """Plan and execute."""
    config = state.config = state.unpack(job["parcel"])
    paths, prepared = _paths(job), Prepared(**job["prepared"])
    announce = _announcer(channel)
    announce(Stage.START, {"scenario_id": prepared.scenario_id})
    instance = state.instance_of(job)
    fleet = build_fleet(config.fleet, len(instance.fleet))  # recordings leave out the files of robots
    inputs = RunInputs(
        config=config,
        run_id=job["run_id"],
        paths=paths,
        instance=prepared.instance,
        announce=announce,
        hooks=state.hooks,
        progress=lambda **facts: channel.send({"progress": facts}),
    )
    return {"claims": jsonable(drive(inputs, attrs.evolve(instance, fleet=fleet)).message())}


def _judge(job: Job, channel: Channel, state: State) -> Answer:
    """Judge the recording, and make the record."""
    _announcer(channel)(Stage.METRICS, {})
    asked, paths = Asked.of_message({**job["facts"]["asked"], "run_id": job["run_id"]}), _paths(job)
    metrics = _metrics(job, state, {metric["number"] for metric in job["facts"]["others_metrics"]})
    prepared = Prepared(**job["prepared"])
    try:
        claims = Claims.of_message(job["claims"])
    except ValueError as error:
        message = f"what the process of the run says of it has another form: {error}"
        failure = Failure(status=RunStatus.CONTRACT_BROKEN, stage=Stage.METRICS, message=message)
        claims = Claims(failure=failure)
    source = None if asked.task_seed is None else state.unpack.settings(job["parcel"], ("tasks",))["tasks"]
    record = record_of(asked, prepared, claims, paths, metrics, state.folder(paths.instances), source)
    keep(record, paths, job["keep"])
    return {"record": jsonable(record.message())}


def _measure(job: Job, channel: Channel, state: State) -> Answer:
    """Measure one metric of others."""
    del channel
    asked = Asked.of_message({**job["facts"]["asked"], "run_id": job["run_id"]})
    every = range(len(job["parcel"]["config"]["metrics"]))
    metrics = _metrics(job, state, set(every) - {job["metric"]})
    recording = Recording(_paths(job).recording)
    try:
        values, reasons = measure(metrics, finished_run(recording, asked))
    finally:
        recording.close()
    (metric,) = metrics.values()
    named = {
        name: f"{reason} ({title(metric)})" if reason.startswith("the metric ") else reason
        for name, reason in reasons.items()
    }
    return {"measured": [jsonable(values), named]}


STEPS: dict[str, Callable[[Job, Channel, State], Answer]] = {
    "prepare": _prepare,
    "drive": _drive,
    "judge": _judge,
    "measure": _measure,
}


def _metrics(job: Job, state: State, without: set[int]) -> Mapping[str, Metric]:
    """The metrics of a run but some, by their places in the configuration."""
    config = job["parcel"]["config"]
    chosen = [entry for number, entry in enumerate(config["metrics"]) if number not in without]
    parcel = {**job["parcel"], "config": {"metrics": chosen}}
    metrics: Mapping[str, Metric] = state.unpack.settings(parcel, ("metrics",))["metrics"]
    return metrics


def _announcer(channel: Channel) -> Callable[[Stage, Mapping[str, Any]], None]:
    return lambda stage, facts: channel.send({"stage": stage, "at": time.monotonic(), **jsonable(dict(facts))})


def _paths(job: Job) -> RunPaths:
    return RunPaths(
        recording=Path(job["recording"]),
        exports=Path(job["exports"]),
        picture=None if job["picture"] is None else Path(job["picture"]),
    )
