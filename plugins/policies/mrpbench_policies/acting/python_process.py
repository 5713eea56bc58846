"""Runs a policy that is a Python class by another interpreter, whose packages may differ from those of this one."""

import pickle
import subprocess
import tempfile
import weakref
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import numpy as np

from mrpbench_core.api import Float, InputError
from mrpbench_policies.acting.acting import Acting, Arrays, check_choice

SERVER = Path(__file__).with_name("serve.py")


class PythonProcess(Acting):
    """The class `Policy` of a file, as `PythonClass` has it, run by another interpreter. What it remembers stays there.

    Args:
        file: the file.
        python: an interpreter whose environment has NumPy and what the policy needs.

    Raises:
        InputError: the interpreter does not run, or the file defines no such class.
    """

    def __init__(self, file: Path, python: Path) -> None:
        self._file, self._robots, self.memory = file, 0, {}
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 - as long as the process
        command = [python, SERVER, file]
        try:
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log)
        except OSError as error:
            self._log.close()
            raise InputError(f"does not run: {error.strerror}", file=python) from None
        weakref.finalize(self, _end, self._process, self._log)
        if not self._receive():
            raise InputError("defines no class `Policy` with a method `act`", file=file)

    def begin(self, robots: int, seed: int) -> None:
        """Make a new policy."""
        self._robots = robots
        self._ask("begin", robots, seed)

    def act(self, observations: Arrays) -> Float:
        """Ask the policy."""
        arrays = {name: (array.dtype.str, array.shape, array.tobytes()) for name, array in observations.items()}
        kind, shape, data = self._ask("act", arrays)
        return check_choice(np.frombuffer(data, kind).reshape(shape), self._robots, self._file)

    def _ask(self, *request: Any) -> Any:
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):  # then `_receive` says how the process ended
            pickle.dump(request, self._process.stdin)
            self._process.stdin.flush()
        return self._receive()

    def _receive(self) -> Any:
        assert self._process.stdout is not None
        try:
            return pickle.load(self._process.stdout)  # noqa: S301 - from the process that this one started
        except (EOFError, pickle.UnpicklingError):
            self._process.wait()
            self._log.seek(0)
            lines = self._log.read().decode(errors="replace").split("\n")
            last = next((line for line in reversed(lines) if line.strip()), "no message")
            raise InputError(f"its process ended: {last.strip()[:300]}", file=self._file) from None


def _end(process: "subprocess.Popen[bytes]", log: IO[bytes]) -> None:
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout, log):
        if stream is not None:
            with suppress(BrokenPipeError):  # of a request that was not sent
                stream.close()
