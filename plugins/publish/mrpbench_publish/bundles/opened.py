"""An unpacked bundle of a stranger: its files and records, none of which has been checked yet."""

import json
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results
from mrpbench_core.store.shards import read_shard
from mrpbench_publish.bundles.folder import Documents, read_documents
from mrpbench_publish.files.bag import read_info
from mrpbench_publish.files.layout import INPUT_FOLDER, INPUTS, RESULTS

_BASE = re.compile(r"\.|_(/_)*")
_LONGEST = 4096


@attrs.frozen(kw_only=True)
class Stored:
    """A record with its place."""

    shard: str
    """Name of its invocation."""
    record: dict[str, Any] = attrs.field(repr=False)
    counts: bool
    """It is the record of the last attempt of its run."""

    @property
    def run_id(self) -> str:
        """Id of the run."""
        return str(self.record["run_id"])

    @property
    def provenance(self) -> dict[str, Any]:
        """Where the record says that it comes from."""
        return self.record.get("provenance") or {}

    @property
    def machine(self) -> dict[str, Any]:
        """The machine that it says it was made on."""
        value = self.provenance.get("machine")
        return value if isinstance(value, dict) else {}

    def block(self, key: str) -> dict[str, Any]:
        """A block of its configuration; empty for anything else."""
        value = self.record["config"].get(key)
        return value if isinstance(value, dict) else {}

    @property
    def files(self) -> list[str]:
        """SHA-256 and name of each file that the record names."""
        value = self.provenance.get("files")
        return [line for line in value if isinstance(line, str)] if isinstance(value, list) else []

    @property
    def recording(self) -> str | None:
        """SHA-256 of the recording that the record names."""
        return next((line[:64] for line in self.files if "  recordings/" in line), None)


@attrs.frozen(kw_only=True)
class Opened:
    """The content of a bundle."""

    top: Path
    results: Results
    documents: Documents
    info: Mapping[str, str]
    folder: Path
    """Folder of the configuration, among the inputs."""
    names: Mapping[str, str]
    """Relative names of files that configurations give in full."""
    left_out: Mapping[str, str]
    """SHA-256 of inputs that are not in the bundle, by their names relative to the folder of the configuration."""

    def records(self) -> Iterator[Stored]:
        """Read all records, of every attempt, in the order in which they were stored."""
        for shard in self.results.folder.shards():
            for offset, record in read_shard(shard):
                counts = self.results.is_last(record["run_id"], shard, offset)
                yield Stored(shard=shard.stem, record=record, counts=counts)

    def leaves_inputs(self, name: str) -> bool:
        """Tell whether a name, relative to the folder of the configuration, leads out of the inputs."""
        root = self.top / INPUT_FOLDER
        return not Path(os.path.normpath(self.folder / name)).is_relative_to(root)


def open_bundle(top: Path) -> Opened:
    """Read what the other checks need.

    Raises:
        InputError: a part is missing or cannot be read.
    """
    results = Results(ResultsFolder(top / RESULTS))
    if not (results.folder.path / "runs").is_dir():
        raise InputError(f"has no {RESULTS}/runs")
    base, names, left_out = _inputs(top / INPUTS)
    folder = top / INPUT_FOLDER / base
    folder.mkdir(parents=True, exist_ok=True)
    return Opened(
        top=top,
        results=results,
        documents=read_documents(results.folder),
        info=read_info(top),
        folder=Path(os.path.normpath(folder)),
        names=names,
        left_out=left_out,
    )


def _inputs(file: Path) -> tuple[str, dict[str, str], dict[str, str]]:
    """The folder of the configuration, relative names by full ones, and the SHA-256 of inputs that are left out."""
    if not file.is_file():
        return ".", {}, {}
    try:
        data = json.loads(read_text(file))
        base, names, left_out = data["folder"], data["absolute"], data.get("left_out", {})
        if not (_BASE.fullmatch(base) and len(base) < _LONGEST and all(full.startswith("/") for full in names)):
            raise ValueError("names of folders")
        texts = [{str(key): str(value) for key, value in part.items()} for part in (names, left_out)]
        return base, texts[0], texts[1]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise InputError(f"{INPUTS} is damaged: {error}") from None
