"""The exports of one run. The failure of one export costs neither the run nor the other exports."""

import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mrpbench_core.api.format import FormatWriter, WritableFormat
from mrpbench_core.files.disk import is_full
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext


class Exports:
    """Passes chunks to the writer of every format, except those that failed."""

    def __init__(self) -> None:
        self.failed: dict[str, str] = {}
        """The reason why an export failed, by its name."""
        self._open: dict[str, FormatWriter] = {}

    def open(self, formats: Mapping[str, WritableFormat], context: RunContext, folder: Path) -> None:
        """Begin them in `folder`.

        Raises:
            InputError: an option of a format does not fit.
        """
        if formats:
            folder.mkdir(parents=True, exist_ok=True)
        for name, chosen in formats.items():
            try:
                self._open[name] = chosen.open(context, folder / name)
            except (InputError, MemoryError):  # the user's to mend; the run's limit
                raise
            except (Exception, SystemExit) as error:  # noqa: BLE001 - a plugin may raise anything
                self._note(name, error)

    def write(self, chunk: Chunk) -> None:
        """Pass a chunk to them."""
        self._each(lambda writer: writer.write(chunk))

    def close(self) -> None:
        """Finish them."""
        self._each(lambda writer: writer.close())

    def abandon(self) -> None:
        """Abandon all exports because the run failed."""
        for name in list(self._open):
            self._drop(name)

    def _each(self, act: Callable[[FormatWriter], Any]) -> None:
        for name, writer in list(self._open.items()):
            try:
                act(writer)
            except MemoryError:
                raise
            except (Exception, SystemExit) as error:  # noqa: BLE001 - as above
                self._note(name, error)
                self._drop(name)

    def _drop(self, name: str) -> None:
        try:
            self._open.pop(name).abandon()
        except (Exception, SystemExit):  # noqa: BLE001 - as above; what failed first is what to tell
            traceback.print_exc()

    def _note(self, name: str, error: BaseException) -> None:
        if is_full(error):  # the run is to be done again, with this export
            raise error
        traceback.print_exc()  # into the run's log
        self.failed[name] = one_line(error)
