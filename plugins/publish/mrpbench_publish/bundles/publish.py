"""Makes a bundle of results folders."""

import json
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.links import followed
from mrpbench_core.files.text import counted
from mrpbench_core.store.instances import InstanceFolder
from mrpbench_core.store.invocation import dumps
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results
from mrpbench_core.store.run_files import check_recording, digest
from mrpbench_core.store.shards import read_shard
from mrpbench_core.version import __version__
from mrpbench_publish.bundles.expected import Expected, expect, named_files
from mrpbench_publish.bundles.folder import Documents, read_documents
from mrpbench_publish.bundles.inputs import collect_inputs, full_names
from mrpbench_publish.bundles.sample import drawn
from mrpbench_publish.files.archive import pack
from mrpbench_publish.files.bag import tag_files
from mrpbench_publish.files.description import Author, Description
from mrpbench_publish.files.layout import CITATION, CRATE, INPUTS, RESULTS, STUDY

FORMAT = "1"
"""Raised when a reader of the old format would misread the new one."""
_SHOWN = 3
"""Runs that an error names."""


@attrs.frozen(kw_only=True)
class PublishOptions:
    """What the publisher decides."""

    title: str | None = None
    text: str | None = None
    authors: tuple[Author, ...] = ()
    license: str = "CC-BY-4.0"
    published: str | None = None
    """Date; None = that of the newest invocation, so that the same results give the same bundle."""
    recordings: float = 1.0
    """The share of the recordings to include, drawn by the ids of their runs."""
    inputs: Path = attrs.field(factory=Path.cwd, converter=followed)
    """Folder of the configuration."""
    left_out: tuple[str, ...] = ()
    """Patterns of the names of inputs that the bundle gives by SHA-256 only, such as `*.map`."""


@attrs.frozen(kw_only=True)
class Published:
    """A written bundle."""

    file: Path
    sha256: str
    runs: int
    recordings: int
    notes: tuple[str, ...]
    """What the publisher should know."""


def publish(folders: Sequence[Results], out: Path, options: PublishOptions, slots: str) -> Published:
    """Write a bundle of finished results.

    Raises:
        InputErrors, InputError: what cannot be published, and why.
    """
    read = [(results, read_documents(results.folder)) for results in folders]
    if faults := [InputError(fault, file=results.folder.path) for results, it in read for fault in it.faults]:
        raise InputErrors(*faults)
    _require_each_once(folders)
    documents = {name: document for _, documents_of in read for name, document in documents_of.by_name.items()}
    names = full_names([[entry["study"], entry.get("overrides") or []] for entry in documents.values()], options.inputs)
    expected = _expected(read, names, options.inputs, slots)
    _require_finished(folders, expected)
    _require_one_version(folders, expected)
    inputs = collect_inputs(expected, options.inputs, options.left_out)
    recordings = _recordings(folders, options.recordings)
    newest = max(documents)
    title = options.title or expected[-1].study.name
    runs = sum(map(len, folders))
    description = Description(
        title=title,
        text=options.text or f"{counted(runs, 'run')} of the study {title}, made with mrpbench.",
        authors=options.authors or (Author(name=f"The authors of {title}"),),
        license=options.license,
        published=options.published or str(documents[newest].get("started"))[:10],
    )
    payload: dict[str, Path | bytes] = {
        **{f"{RESULTS}/runs/{shard.name}": _lines(shard) for results in folders for shard in results.folder.shards()},
        **{f"{RESULTS}/invocations/{name}.yaml": _document(folders, name) for name in documents},
        **recordings,
        **inputs.files,
        STUDY: dumps(documents[newest]["study"]).encode(),
        CITATION: description.citation(__version__),
    }
    if inputs.names:
        absolute = {full: name for full, name in names.items() if name in inputs.names}
        place = {"folder": inputs.folder, "absolute": absolute, "left_out": inputs.left_out}
        payload[INPUTS] = (json.dumps(place, indent=1) + "\n").encode()
    payload[CRATE] = description.crate([*payload, CRATE], documents, __version__)
    info = {
        "Bag-Software-Agent": f"mrpbench {__version__}",
        "Bagging-Date": description.published,
        "External-Description": title,
        "Mrpbench-Bundle-Format": FORMAT,
        "Mrpbench-Recordings": f"{options.recordings:g}",
    }
    top = f"mrpbench-{sha256(title.encode()).hexdigest()[:8]}"
    entries = {f"{top}/{name}": part for name, part in {**payload, **tag_files(payload, info)}.items()}
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        pack(out, entries, frozenset(f"{top}/{name}" for name in inputs.programs))
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=error.filename or out) from error
    notes = [f"{name} is a program; check that its licence lets you publish it" for name in sorted(inputs.programs)]
    notes += [f"{name} is left out; `mrpbench verify --inputs DIR` takes it from DIR" for name in inputs.left_out]
    notes += [str(error) for results in folders for error in results.damaged]
    return Published(
        file=out,
        sha256=digest(out),
        runs=runs,
        recordings=sum("/recordings/" in name for name in recordings),
        notes=tuple(notes),
    )


def _expected(
    read: Sequence[tuple[Results, Documents]], names: Mapping[str, str], folder: Path, slots: str
) -> list[Expected]:
    """The runs that the invocations describe; those of the newest invocation are last."""
    asked: dict[str, Any] = {}
    for results, documents in read:
        for name, invocation in sorted(documents.invocations(results, names).items()):
            asked.pop(repr(invocation), None)
            asked[repr(invocation)] = name, invocation
    newest_last = sorted(asked.values(), key=lambda entry: entry[0])
    return [expect(slots, invocation, folder, trusted=True) for _, invocation in newest_last]


def _require_each_once(folders: Sequence[Results]) -> None:
    if not any(map(len, folders)):
        raise InputError("no run is recorded here yet", file=folders[0].folder.path)
    results_of: dict[str, Results] = {}
    for results in folders:
        for record in results:
            other = results_of.setdefault(record["run_id"], results)
            if other is not results:
                raise InputError(
                    f"run {record['run_id']} is also in {other.folder.path}",
                    file=results.folder.path,
                    hint="publish one of the folders, or two bundles",
                )


def _require_finished(folders: Sequence[Results], expected: Sequence[Expected]) -> None:
    """Require that the records are those of the studies, no less and no more."""
    wanted = {point.run_id for entry in expected for point in entry.study.runs}
    recorded = {record["run_id"] for results in folders for record in results}
    if missing := sorted(wanted - recorded):
        raise InputError(
            f"{counted(len(missing), 'run')} of {len(wanted)} of the study have no record ({_some(missing)})",
            file=folders[0].folder.path,
            hint="the study is unfinished: `mrpbench run` continues it",
        )
    if unknown := sorted(recorded - wanted):
        errors = [error for entry in expected for error in entry.study.errors]
        raise InputErrors(
            *errors,
            InputError(
                f"{counted(len(unknown), 'record')} do not follow from the studies ({_some(unknown)})",
                file=folders[0].folder.path,
                hint="give the folder of the configuration with --inputs, and install its plugins",
            ),
        )


def _require_one_version(folders: Sequence[Results], expected: Sequence[Expected]) -> None:
    """Require one version of each distribution, and files and local plugins as they were."""
    now = {point.run_id: point for those in expected for point in those.study.runs}
    versions: dict[str, set[str]] = {}
    for results in folders:
        for record in results:
            if [*named_files(record["config"])] != [*named_files(now[record["run_id"]].canonical)]:
                raise InputError(
                    f"run {record['run_id']} names its files by other relative names",
                    file=results.folder.path,
                    hint="give the folder of the configuration with --inputs",
                )
            made = record.get("provenance") or {}
            for name, version in (made.get("versions") or {}).items():
                versions.setdefault(name, set()).add(version)
            for entry in made.get("components") or ():
                if "file" in entry and entry not in now[record["run_id"]].code["components"]:
                    raise InputError(
                        f"has changed since run {record['run_id']}",
                        file=entry["file"],
                        hint="restore it, or repeat the runs with --rerun changed",
                    )
    if mixed := {name: those for name, those in versions.items() if len(those) > 1}:
        raise InputError(
            "the records have several versions: "
            + "; ".join(f"{name} {' and '.join(sorted(those))}" for name, those in sorted(mixed.items())),
            file=folders[0].folder.path,
            hint="`mrpbench run --rerun changed` repeats the older ones",
        )


def _recordings(folders: Sequence[Results], share: float) -> dict[str, Path | bytes]:
    """The recordings to include by name in the bundle, and their instances."""
    recorded: dict[str, tuple[Results, dict[str, Any]]] = {}
    for results in folders if share else ():
        for record in results:
            if any("  recordings/" in line for line in (record.get("provenance") or {}).get("files") or ()):
                recorded[record["run_id"]] = results, record
    files: dict[str, Path | bytes] = {}
    for run_id in drawn(recorded, share):
        results, record = recorded[run_id]
        file = results.paths(run_id).recording
        if not file.is_file():
            raise InputError("is no longer there", file=file, hint="`--recordings none` publishes the records alone")
        check_recording(record, file)
        files[f"{RESULTS}/recordings/{file.name}"] = file
        recording = Recording(file)
        name = recording.instance_name
        recording.close()
        if name is not None:
            parts = InstanceFolder(results.folder.instances).files_of(name)
            files |= {f"{RESULTS}/instances/{part.name}": part for part in parts}
    return files


def _lines(shard: Path) -> Path | bytes:
    """A file of records; without the lines that are no records, if there are some."""
    damaged: list[InputError] = []
    offsets = [offset for offset, _ in read_shard(shard, damaged)]
    content = shard.read_bytes()
    if not damaged and (not content or content.endswith(b"\n")):
        return shard
    return b"".join(content[offset : content.index(b"\n", offset) + 1] for offset in offsets)


def _document(folders: Sequence[Results], name: str) -> Path:
    places = [results.folder.invocation(name) for results in folders]
    return next(place for place in places if place.is_file())


def _some(run_ids: Sequence[str]) -> str:
    return ", ".join(run_ids[:_SHOWN]) + (", …" if len(run_ids) > _SHOWN else "")
