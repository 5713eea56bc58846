"""Runs a policy that is a Python class by another interpreter, whose packages may differ from those of this one."""

import pickle
import signal
import subprocess
import tempfile
import weakref
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from mrpbench_core.api import Float, InputError
from mrpbench_policies.acting.acting import Acting, Arrays, check_choice
from mrpbench_policies.acting.serve import arrays_of, plain

SERVER = Path(__file__).with_name("serve.py")


class PythonProcess(Acting):
    """The class `Policy` of a file, as `PythonClass` has it, run by another interpreter.

    Args:
        file: the file.
        python: an interpreter whose environment has NumPy and what the policy needs.
        weights: a file that the class reads.

    Raises:
        InputError: the interpreter does not run, or the file defines no such class.
    """

    def __init__(self, file: Path, python: Path, weights: Path | None = None) -> None:
        self._file, self._robots, self.memory = file, 0, {}
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 - as long as the process
        command = [python, SERVER, file, *([] if weights is None else [weights])]
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
        self.memory = arrays_of(self._ask("begin", robots, seed))

    def act(self, observations: Arrays) -> Float:
        """Ask the policy."""
        answer, memory = self._ask("act", plain(observations), plain(self.memory))
        self.memory = arrays_of(memory)
        return check_choice(arrays_of({"answer": answer})["answer"], self._robots, self._file)

    def _ask(self, *request: Any) -> Any:
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):  # then `_receive` says how the process ended
            pickle.dump(request, self._process.stdin)
            self._process.stdin.flush()
        return self._receive()

    def _receive(self) -> Any:
        assert self._process.stdout is not None
        try:
            failure, line, answer = pickle.load(self._process.stdout)  # noqa: S301 - from the process that this one started
        except (EOFError, pickle.UnpicklingError):
            status = self._process.wait()
            how = f"exit code {status}" if status >= 0 else signal.Signals(-status).name
            self._log.seek(0)
            lines = self._log.read().decode(errors="replace").split("\n")
            last = next((f": {line.strip()[:300]}" for line in reversed(lines) if line.strip()), "")
            raise InputError(f"its process ended with {how}{last}", file=self._file) from None
        if failure:
            raise InputError(failure[:300], file=self._file, line=line)
        return answer


def _end(process: "subprocess.Popen[bytes]", log: IO[bytes]) -> None:
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout, log):
        if stream is not None:
            with suppress(BrokenPipeError):  # of a request that was not sent
                stream.close()
