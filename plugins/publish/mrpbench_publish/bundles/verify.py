"""Verifies a bundle of a stranger, from cheap checks to dear ones."""

import secrets
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.call import CallFailedError, call
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.store.run_files import digest
from mrpbench_core.version import __version__
from mrpbench_publish.bundles.checks.bag import description_faults, file_faults, reference_faults
from mrpbench_publish.bundles.checks.code import code_faults
from mrpbench_publish.bundles.checks.instances import measured_faults, recording_faults, scenario_ids
from mrpbench_publish.bundles.checks.records import (
    record_faults,
    scenario_faults,
    scenario_key,
    status_faults,
    timing_faults,
)
from mrpbench_publish.bundles.checks.repetition import is_comparable, repeat, repetition_faults, same_platform
from mrpbench_publish.bundles.checks.study import (
    Asked,
    outside_faults,
    read_studies,
    study_faults,
    uses_local_code,
)
from mrpbench_publish.bundles.inputs import take_inputs
from mrpbench_publish.bundles.opened import Opened, Stored, open_bundle
from mrpbench_publish.bundles.sample import drawn
from mrpbench_publish.bundles.verdict import Check, Fault, Verdict, checked
from mrpbench_publish.files.archive import unpack

RECORDING_S = 1800.0
"""Wall seconds that the check of one recording, or of all scenarios, may take."""


@attrs.frozen(kw_only=True)
class VerifyOptions:
    """What the verifier decides."""

    rerun: float = 0.0
    """The share of the runs to repeat."""
    seed: str | None = None
    """Draws these runs; None = a new one. The publisher must not know it before."""
    trusted: bool = False
    """Execute local plugins and programs of the bundle."""
    inputs: Path | None = None
    """Folder with the inputs that the bundle leaves out, by their names relative to the folder of the configuration."""
    workers: int = 1
    progress: StudyProgress = attrs.field(factory=StudyProgress)


def verify(file: Path, options: VerifyOptions, slots: str, said: Callable[[Check], object] | None = None) -> Verdict:
    """Check a bundle.

    Args:
        file: the bundle, a zip file.
        options: how much to check.
        slots: see `slots_of_this_process`.
        said: called with each check when it is done, if given.

    Raises:
        InputError: there is no such file, or an input that is given is another one.
    """
    if not file.is_file():
        raise InputError("no such file" if not file.exists() else "is not a file; a bundle is a zip file", file=file)
    seed = (options.seed or secrets.token_hex(8)) if options.rerun else None
    checks: list[Check] = []
    with TemporaryDirectory(prefix="mrpbench-verify-") as name:
        for check in _checks(file, Path(name), attrs.evolve(options, seed=seed), slots):
            checks.append(check)
            if said is not None:
                said(check)
    return Verdict(bundle=file.name, sha256=digest(file), version=__version__, checks=tuple(checks), seed=seed)


def _checks(file: Path, folder: Path, options: VerifyOptions, slots: str) -> Iterator[Check]:
    size = f"{file.stat().st_size / 1e6:.2g} MB"
    try:
        unpack(file, folder, programs=options.trusted)
        tops = list(folder.iterdir())
        if len(tops) != 1 or not tops[0].is_dir():
            raise InputError(f"is refused: it has {len(tops)} entries at its top, and a bundle has one folder")
        bundle = open_bundle(tops[0])
    except InputError as error:
        yield checked("archive", [error.message], size)
        return
    yield checked("archive", (), size)
    yield checked("files", file_faults(bundle), "names, sizes and SHA-256 of all files")
    yield checked("description", description_faults(bundle), "RO-Crate, citation and study follow from the files")
    records = [stored for stored in bundle.records() if stored.counts]
    yield from _check_records(bundle, records)
    if missing := take_inputs(bundle, options.inputs):
        names = ", ".join(missing[:2]) + (", …" if len(missing) > 2 else "")
        why = f"the bundle leaves out {counted(len(missing), 'input')} ({names}); --inputs DIR gives them"
        for name in ("study", "versions", "inputs", "scenarios", "recordings", "repetition"):
            yield checked(name, (), "", unchecked=why)
        return
    asked = read_studies(bundle, slots, trusted=options.trusted)
    yield from _check_studies(bundle, asked, records, options)
    outside = list(outside_faults(bundle, asked))
    yield checked("inputs", outside, "files of the configuration")
    runs = {} if outside else asked.runs
    known = [stored for stored in records if stored.run_id in runs]
    call_in_worker = _Calls(slots, options.trusted)
    yield _scenarios(known, runs, call_in_worker)
    yield _recordings(bundle, known, runs, call_in_worker)
    yield _repetitions(attrs.evolve(asked, by_name={} if outside else asked.by_name), known, folder, slots, options)


def _check_records(bundle: Opened, records: Sequence[Stored]) -> Iterator[Check]:
    every = counted(len(records), "run")
    yield checked("records", [*record_faults(bundle), *scenario_faults(records)], every)
    yield checked("references", reference_faults(bundle), "records, invocations and recordings belong together")
    columns = {name: document["columns"] for name, document in bundle.documents.by_name.items()}
    yield checked(
        "statuses", _each(records, lambda stored: status_faults(stored, columns.get(stored.shard, {}))), every
    )
    yield checked("times", _each(records, timing_faults), "times agree with each other; they cannot be verified")


def _check_studies(bundle: Opened, asked: Asked, records: Sequence[Stored], options: VerifyOptions) -> Iterator[Check]:
    local = [stored for stored in records if uses_local_code(stored.record["config"])]
    covered = f"{counted(len(asked.runs), 'run')} of the study, each recorded once"
    hidden = not options.trusted and bool(local)
    unchecked = f"{counted(len(local), 'run')} need local plugins; --trust-sources executes them" if hidden else None
    yield checked("study", study_faults(bundle, asked, records), covered, unchecked=unchecked)
    yield checked(
        "versions", code_faults(bundle, asked, records), "versions and sources, also against the installed ones"
    )


@attrs.frozen
class _Calls:
    """Calls functions in worker processes, which refuse local plugins unless they are trusted."""

    slots: str
    trusted: bool

    def __call__(self, function: Callable[..., Any], *arguments: Any) -> Any:
        return call(self.slots, function, *arguments, self.trusted, limit_s=RECORDING_S)


def _scenarios(records: Sequence[Stored], runs: dict[str, StudyRun], call_in_worker: _Calls) -> Check:
    """Draw each scenario again."""
    parcels = {scenario_key(stored.record["config"]): runs[stored.run_id].parcel for stored in records}
    covered = counted(len(parcels), "scenario") + " drawn again"
    if not parcels:
        return checked("scenarios", (), covered, unchecked="no run can be made here")
    try:
        ids = dict(zip(parcels, call_in_worker(scenario_ids, list(parcels.values())), strict=True))
    except CallFailedError as failure:
        return checked("scenarios", [f"they cannot be drawn here: {failure}"], covered)
    faults = [
        (stored.run_id, "does not have the scenario that its configuration draws")
        for stored in records
        if stored.record.get("scenario_id") is not None
        and ids[scenario_key(stored.record["config"])] != stored.record["scenario_id"]
    ]
    return checked("scenarios", faults, covered)


def _recordings(bundle: Opened, records: Sequence[Stored], runs: dict[str, StudyRun], call_in_worker: _Calls) -> Check:
    """Validate the plan of each recording, and compute its metrics again."""
    faults: list[Fault] = []
    count = 0
    for stored in records:
        file = bundle.results.paths(stored.run_id).recording
        if stored.recording is None or not file.is_file():
            continue
        count += 1
        run = runs[stored.run_id]
        try:
            faults_of_run = call_in_worker(recording_faults, run.parcel, run.facts, stored.record, str(file))
            for metric in run.facts["others_metrics"] if stored.record.get("metrics") else ():
                arguments = run.parcel, run.facts, metric["number"], stored.record, str(file)
                faults_of_run += call_in_worker(measured_faults, *arguments)
        except CallFailedError as failure:
            faults_of_run = [f"its recording cannot be checked: {failure}"]
        faults += [(stored.run_id, fault) for fault in faults_of_run]
    covered = counted(count, "recording") + ": plans validated, metrics computed again"
    return checked("recordings", faults, covered, unchecked=None if count else "there are no recordings")


def _repetitions(asked: Asked, records: Sequence[Stored], folder: Path, slots: str, options: VerifyOptions) -> Check:
    if not options.rerun:
        return checked("repetition", (), "", unchecked="no run was repeated (--rerun SHARE)")
    by_id = {stored.run_id: stored for stored in records}
    chosen = [by_id[run_id] for run_id in drawn(by_id, options.rerun, str(options.seed))]
    pairs = repeat(asked, chosen, folder / "again", slots, options.workers, options.progress)
    covered = f"{counted(len(pairs), 'run')} of {len(records)}, drawn by the seed {options.seed}, equal outside timing"
    if bound := sum(not is_comparable(pair) for pair in pairs):
        covered += f"; the clock decided {bound} of them, which are not compared"
    if foreign := sum(not same_platform(stored) for stored, _ in pairs):
        covered += f"; {foreign} were made with another C library, and only their plans are compared"
    missing = {stored.run_id for stored in chosen} - {stored.run_id for stored, _ in pairs}
    faults = [*repetition_faults(pairs), *((run_id, "cannot be repeated here") for run_id in sorted(missing))]
    return checked("repetition", faults, covered, unchecked=None if pairs else "no run can be made here")


def _each(records: Sequence[Stored], faults_of: Callable[[Stored], Iterator[str]]) -> Iterator[Fault]:
    for stored in records:
        yield from ((stored.run_id, fault) for fault in faults_of(stored))
