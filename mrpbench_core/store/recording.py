"""Recordings on disk: one zip of `.npy` chunks by channel, plus the run's context. Readable with NumPy alone."""

import json
import zipfile
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.output import create_file
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext, with_latest_routes

FORMAT = 1
"""Raised when a reader of the old format would misread the new one."""


class RecordingWriter:
    """Appends chunks to a file with a temporary name, so that memory does not grow with the run; `close` renames it."""

    def __init__(self, file: Path, context: RunContext) -> None:
        self.file = file
        self.temporary = file.with_name(f".{file.name}.partial")
        file.parent.mkdir(parents=True, exist_ok=True)
        self._stream = create_file(self.temporary)
        self._zip = zipfile.ZipFile(self._stream, "w")
        self._chunks = 0
        self._arrays = 0
        data = encode(context, self._keep)
        self._put("context.json", json.dumps({"format": FORMAT, "context": data}).encode())

    def _keep(self, array: NDArray[Any]) -> str:
        name = f"context/{self._arrays}.npy"
        self._arrays += 1
        self._put(name, _npy(array))
        return name

    def _put(self, name: str, content: bytes) -> None:
        """Add a file without a date, so that equal recordings are equal byte by byte."""
        self._zip.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, compresslevel=1)

    def write(self, chunk: Chunk) -> None:
        """Append rows to channels."""
        for channel, rows in chunk.items():
            self._put(f"{channel}/{self._chunks:06d}.npy", _npy(rows))
        self._chunks += 1

    def close(self) -> None:
        """Finish the file and give it its name; `seal` brings it to disk."""
        self._zip.close()
        self._stream.close()
        self.temporary.replace(self.file)

    def discard(self) -> None:
        """Delete the unfinished file."""
        self._zip.close()
        self._stream.close()
        self.temporary.unlink(missing_ok=True)


def _npy(array: NDArray[Any]) -> bytes:
    buffer = BytesIO()
    np.save(buffer, array, allow_pickle=False)
    return buffer.getvalue()


class Recording:
    """A stored recording, read channel by channel."""

    def __init__(self, file: Path) -> None:
        if not file.is_file():
            raise InputError("no recording here", file=file, hint="the run kept none, or was not executed")
        try:
            self._zip = zipfile.ZipFile(file)
            header = json.loads(self._zip.read("context.json"))
        except (zipfile.BadZipFile, KeyError, json.JSONDecodeError) as error:
            raise InputError(f"not a recording: {error}", file=file) from error
        if header.get("format") != FORMAT:
            raise InputError(f"recording of format {header.get('format')}, this version reads {FORMAT}", file=file)
        self._context = header["context"]
        self._parts: dict[str, list[str]] = defaultdict(list)
        for name in sorted(self._zip.namelist()):
            channel, _, part = name.rpartition("/")
            if part and channel not in ("", "context"):
                self._parts[channel].append(name)

    def _load(self, name: str) -> NDArray[Any]:
        array: NDArray[Any] = np.load(BytesIO(self._zip.read(name)), allow_pickle=False)
        return array

    def first_context(self) -> RunContext:
        """The context before execution began, as exporters receive it; new plans are in the channels `route_...`."""
        return decode(self._context, RunContext, self._load)

    def context(self) -> RunContext:
        """The context with the routes of the last plan, to which `reached` and `cleared` refer."""
        return with_latest_routes(self.first_context(), self.channels)

    def channel(self, name: str) -> NDArray[Any]:
        """All rows of a channel; scans are as wide as the widest lidar's, filled with NaN."""
        parts = [self._load(part) for part in self._parts[name]]
        if name == "scan_ranges":
            width = max(part.shape[1] for part in parts)
            parts = [np.pad(part, ((0, 0), (0, width - part.shape[1])), constant_values=np.nan) for part in parts]
        return np.concatenate(parts)

    @property
    def channels(self) -> Mapping[str, Callable[[], NDArray[Any]]]:
        """A loader for each channel, by name."""
        return {name: partial(self.channel, name) for name in self._parts}

    def chunks(self) -> Iterator[Chunk]:
        """The chunks as they were written."""
        numbers = sorted({part.rpartition("/")[2] for parts in self._parts.values() for part in parts})
        for number in numbers:
            yield {
                channel: self._load(f"{channel}/{number}")
                for channel, parts in self._parts.items()
                if f"{channel}/{number}" in parts
            }

    def close(self) -> None:
        """Release the file."""
        self._zip.close()
