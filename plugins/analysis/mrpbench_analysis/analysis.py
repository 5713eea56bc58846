"""Measures a recording of a real fleet or of another simulator, and stores the result as a record."""

import hashlib
import os
from datetime import UTC, datetime
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_analysis.observed_run import ObservedRun, Sampling, observe, observe_recording
from mrpbench_core.api.component import Component
from mrpbench_core.api.format import Observed, ReadableFormat
from mrpbench_core.api.metric import Metric
from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.canonical import canonical_component
from mrpbench_core.config.settings import FleetEntry
from mrpbench_core.engine.loading.versions import with_versions
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.record import RunError, RunRecord, StoredRecord
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer, line
from mrpbench_core.files.links import followed
from mrpbench_core.files.output import sync_file_system
from mrpbench_core.files.robot import load_robot
from mrpbench_core.files.scenario import read_scenario
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.runs.arrivals import arrival_times
from mrpbench_core.model.runs.routes import with_latest_routes
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.checkout import version_of
from mrpbench_core.plugins.provenance import provenance
from mrpbench_core.referee.measuring import describe, measure
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.store.folder import ResultsFolder, new_invocation
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.lock import locked
from mrpbench_core.store.recording import RecordingWriter
from mrpbench_core.store.results import Results
from mrpbench_core.store.run_files import seal

BLOCK = 2**20
UNIDENTIFYING = ("name", "metrics", "simulator")
DISTRIBUTION = "mrpbench-analysis"
LENGTH = 16
"""Hexadecimal digits of a run id."""


@attrs.frozen(kw_only=True)
class Analysis:
    """The recording to measure, and how to measure it."""

    bag: Path
    format: ReadableFormat
    metrics: dict[str, Metric]
    world: WorldSource | None = None
    """None = as the recording says, which only those of mrpbench do."""
    scenario: Path | None = None
    robot: str = "turtlebot3_burger"
    """Model of all robots, by name or file."""
    robots: tuple[str, ...] = ()
    """Names or shell patterns, in the scenario's order; () = all."""
    sampling: Sampling = Sampling()
    label: str = "recorded"
    """The label that tables show in the column `simulator`."""
    out: Path = Path("results")


def analyze(analysis: Analysis) -> dict[str, Any]:
    """Measure, keep the record and the recording in the results folder, and return the record.

    Raises:
        InputError: the recording cannot be read or does not fit the scenario; says what there is.
    """
    observed = _in_order(analysis.format.read(analysis.bag, analysis.robots), analysis.robots)
    observed_run = _observe(analysis, observed)
    identity = _identity(analysis, observed_run)
    first = attrs.evolve(observed_run.context, run_id=identity)
    if first.result.plan is not None:
        first = attrs.evolve(first, result=judge_plan(Promises.none(), first.problem, first.result)[0])
    known = {name: rows for name, rows in observed_run.channels.items() if not (observed_run.gaps and name == "truth")}
    channels = {name: _loader(rows) for name, rows in known.items()}
    context = with_latest_routes(first, channels)
    run = FinishedRun(
        context=context,
        executed=True,
        channels=channels,
        alike=observed_run.alike,
        first_routes=first.routes,
        ended=not observed_run.open_ends,
    )
    values, reasons = measure(analysis.metrics, run)
    for lacking, why in (("no truth", observed_run.gaps), ("no end", observed_run.open_ends)):
        if why:
            reasons |= {name: "; ".join(why) for name, reason in reasons.items() if reason.startswith(lacking)}
    status, message = _status(observed_run, run)
    record = StoredRecord(
        run=RunRecord(
            run_id=identity,
            scenario_id=context.scenario.id,
            status=status,
            error=None if message is None else RunError(stage=Stage.ANALYSIS, message=message),
            metrics=values,
            unmeasured=reasons,
        ),
        attempt=1,
        config=_config(analysis, context.fleet),
        seed=0,
        repeat=0,
        provenance={**_code(analysis), "machine": machine(), "live": False},
        analysis={
            "bag": followed(analysis.bag).name,
            "sources": {track.robot: f"{track.source}: {track.topic}" for track in observed_run.tracks},
            "planned": run.planned,
            "notes": [*observed_run.notes, *observed_run.gaps, *_unknown_end(observed_run)],
        },
    )
    return _keep(analysis, attrs.evolve(observed_run, context=first), record).document()


def _loader(rows: Any) -> Any:
    return lambda: rows


def _in_order(observed: Observed, robots: tuple[str, ...]) -> Observed:
    """Tracks in the order in which their robots are named; those that one pattern names keep their own."""
    if not robots:
        return observed
    rank = {
        track.robot: next(index for index, pattern in enumerate(robots) if fnmatchcase(track.robot, pattern))
        for track in observed.tracks
    }
    return attrs.evolve(observed, tracks=tuple(sorted(observed.tracks, key=lambda track: rank[track.robot])))


def _observe(analysis: Analysis, observed: Observed) -> ObservedRun:
    context = observed.context
    scenario = None if analysis.scenario is None else read_scenario(analysis.scenario)
    if context is not None and scenario is not None and scenario.id != context.scenario.id:
        raise InputError(
            f"is scenario {scenario.id}, the recording was made of {context.scenario.id}", file=analysis.scenario
        )
    cut = analysis.sampling.since is not None or analysis.sampling.until is not None
    names = tuple(track.robot for track in observed.tracks)
    if context is not None and "time" in observed.channels and names == context.fleet.names and not cut:
        return observe_recording(observed, context)
    world = None if analysis.world is None else analysis.world.load()
    if context is not None:
        world, scenario = world or context.world, context.scenario
    for value, name in ((world, "--world"), (scenario, "--scenario")):
        if value is None:
            raise InputError(f"a recording that mrpbench did not write needs {name}", file=analysis.bag)
    assert world is not None
    assert scenario is not None
    if context is not None:
        return observe(observed, world, context.fleet, scenario, analysis.sampling, assigned=context.assigned)
    fleet = Fleet(robots=(load_robot(analysis.robot),) * len(scenario.start))
    ordered = len(analysis.robots) == len(scenario.start)
    return observe(observed, world, fleet, scenario, analysis.sampling, ordered=ordered)


def _unknown_end(observed: ObservedRun) -> list[str]:
    """The note about an end that is not known."""
    return [f"how the run ended is unknown: {'; '.join(observed.open_ends)}"] if observed.open_ends else []


def _status(observed: ObservedRun, run: FinishedRun) -> tuple[RunStatus, str | None]:
    """The status of the run, as far as the recording shows it, and the reason if it did not succeed."""
    arrived = np.isfinite(arrival_times(run))
    if arrived.all():
        return RunStatus.SUCCEEDED, None
    mode = observed.channels.get("mode")
    if mode is not None and (mode[-1] == Mode.ABORTED).any():
        return RunStatus.EXECUTION_ABORTED, "a robot gave up before all had arrived"
    if observed.open_ends:
        return RunStatus.UNKNOWN, "; ".join(observed.open_ends)
    missed = f"{np.count_nonzero(~arrived)} of {len(arrived)} robots are not seen to arrive"
    return RunStatus.GOALS_MISSED, "; ".join((missed, *observed.gaps))


def _config(analysis: Analysis, fleet: Fleet) -> dict[str, Any]:
    """The known facts of the run under configuration keys, so that tables can compare it with other runs."""
    plain: dict[str, Any] = {"name": analysis.out.name}
    if analysis.world is not None:
        plain["world"] = _plain(analysis.world)
    models = [robot.name for robot in fleet.profiles[0]]
    return plain | {
        "fleet": [dict.fromkeys(attrs.fields_dict(FleetEntry)) | {"robot": name} for name in models],
        "simulator": {"plugin": analysis.label},
        "metrics": [_plain(metric) for metric in analysis.metrics.values()],
        "recording": {"rate": analysis.sampling.rate},
        "analysis": {"format": _plain(analysis.format), **attrs.asdict(analysis.sampling)},
    }


def _plain(component: Component) -> dict[str, Any]:
    return canonical_component(component, Path.cwd())


def _identity(analysis: Analysis, observed: ObservedRun) -> str:
    """Hash of the bytes of the recording and of the options of the analysis, without metrics and paths of files."""
    digest = hashlib.sha256()
    files = [analysis.bag] if analysis.bag.is_file() else sorted(analysis.bag.iterdir())
    for file in (file for file in files if file.is_file()):
        with file.open("rb") as stream:
            while block := stream.read(BLOCK):
                digest.update(block)
    config = {
        key: value for key, value in _config(analysis, observed.context.fleet).items() if key not in UNIDENTIFYING
    }
    config["robots"], config["scenario"] = analysis.robots, observed.context.scenario.id
    digest.update(line(config).encode())
    return digest.hexdigest()[:LENGTH]


def _code(analysis: Analysis) -> dict[str, Any]:
    code = with_versions(provenance([analysis.format, analysis.world, *analysis.metrics.values()], Path.cwd()))
    return code | {"versions": code["versions"] | {DISTRIBUTION: version_of(DISTRIBUTION)}}


def _keep(analysis: Analysis, observed: ObservedRun, record: StoredRecord) -> StoredRecord:
    """Store recording and record; returns the record with the number of this attempt."""
    folder = ResultsFolder(analysis.out)
    folder.create()
    with locked(folder.path):
        folder.sweep()
        run_id = record.run.run_id
        before = Results(folder, only=[run_id]).entry(run_id)
        attempt = 1 if before is None else before.attempt + 1
        record = attrs.evolve(record, attempt=attempt)
        invocation = new_invocation()
        folder.forget(run_id, attempt)
        paths = folder.run(run_id, attempt)
        writer = RecordingWriter(paths.recording, observed.context)
        try:
            writer.write(observed.channels)
        except BaseException:
            writer.discard()
            raise
        writer.close()
        record.run.files = seal(paths)
        sync_file_system(folder.path)
        digest = write_document(folder.invocation(invocation), _facts(analysis, record, invocation))
        record = attrs.evolve(record, invocation=f"{digest}  invocations/{invocation}.yaml")
        with Writer(folder.shard(invocation), exclusive=True) as shard:
            shard.write(record.document())
        folder.forget_before(run_id, attempt)
    return record


def _facts(analysis: Analysis, record: StoredRecord, invocation: str) -> dict[str, Any]:
    return {
        "invocation": invocation,
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        "process": os.getpid(),
        "machine": record.provenance["machine"],
        "versions": record.provenance["versions"],
        "columns": describe(analysis.metrics),
        "analysis": record.config | (record.analysis or {}),
    }
