"""The exports of one run. The failure of one export costs neither the run nor the other exports."""

import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mrpbench_core.api.exporter import Exporter, ExporterSession
from mrpbench_core.files.disk import is_full
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext


class Exports:
    """Passes chunks to every exporter, except those that failed."""

    def __init__(self) -> None:
        self.failed: dict[str, str] = {}
        """The reason why an export failed, by its name."""
        self._open: dict[str, ExporterSession] = {}

    def open(self, exporters: Mapping[str, Exporter], context: RunContext, folder: Path) -> None:
        """Begin them in `folder`.

        Raises:
            InputError: an exporter's option does not fit.
        """
        if exporters:
            folder.mkdir(parents=True, exist_ok=True)
        for name, exporter in exporters.items():
            try:
                self._open[name] = exporter.open(context, folder / name)
            except (InputError, MemoryError):  # the user's to mend; the run's limit
                raise
            except (Exception, SystemExit) as error:  # noqa: BLE001 - a plugin may raise anything
                self._note(name, error)

    def write(self, chunk: Chunk) -> None:
        """Pass a chunk to the exporters."""
        self._each(lambda session: session.write(chunk))

    def close(self) -> None:
        """Finish them."""
        self._each(lambda session: session.close())

    def abandon(self) -> None:
        """Abandon all exports because the run failed."""
        for name in list(self._open):
            self._drop(name)

    def _each(self, act: Callable[[ExporterSession], Any]) -> None:
        for name, session in list(self._open.items()):
            try:
                act(session)
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
