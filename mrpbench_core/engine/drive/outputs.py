"""The recording and the exports of a run, as one place to write to."""

from types import TracebackType
from typing import Self

from mrpbench_core.engine.drive.export import Exports
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.stage import RunInputs
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.runs.status import Stage
from mrpbench_core.store.recording import RecordingWriter


class Outputs:
    """Writes chunks; no unfinished recording or export gets its final name.

    Args:
        inputs: of the run.
        context: of the run.
    """

    def __init__(self, inputs: RunInputs, context: RunContext) -> None:
        self._inputs, self._context = inputs, context
        self._exports = Exports()
        self._recorder: Recorder | None = None
        self._executed = False

    def __enter__(self) -> Self:
        self._writer = RecordingWriter(self._inputs.paths.recording, self._context, self._inputs.instance)
        return self

    def begin(self) -> None:
        """Begin the exports, since there will be an execution.

        Raises:
            InputError: an option of a format does not fit.
        """
        self._executed = True
        self._exports.open(self._inputs.config.export, self._context, self._inputs.paths.exports)

    def recorder(self) -> Recorder:
        """Return what collects the control periods of an execution."""
        config = self._inputs.config
        self._recorder = Recorder(
            config.recording.rate,
            self._context.period,
            self.write,
            config.recording.scans or bool(config.export),
            tasks=config.tasks is not None,
            trajectories=config.recording.trajectories is not None and config.execution == "simulated",
        )
        return self._recorder

    def write(self, chunk: Chunk) -> None:
        """Append rows to channels."""
        scans = self._inputs.config.recording.scans
        self._writer.write({name: rows for name, rows in chunk.items() if scans or not name.startswith("scan_")})
        self._exports.write(chunk)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if error is not None:
            self._writer.discard()
            self._exports.abandon()
            return
        if self._recorder is not None:
            self._recorder.flush()
        self._writer.close()

    def export(self) -> dict[str, str]:
        """Finish the exports; return why one failed, by its name."""
        if self._executed:
            self._inputs.announce(Stage.EXPORT, {})
            self._exports.close()
        return self._exports.failed
