"""The invoker's view of a worker process: starts it, exchanges messages, measures its memory and ends it."""

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import psutil

WORKER = "mrpbench_core.engine.processes.worker"

SAMPLING_S = 0.1
"""Seconds between measurements of a worker's memory, or more where a measurement takes long."""

CLOSING_S = 1.0
"""Seconds between the end of a worker's messages and its own."""


class WorkerDied(Exception):  # noqa: N818 - it says what happened
    """The process ended without an answer; the message says how."""

    def __init__(self, message: str, signal_number: int | None = None) -> None:
        self.signal = signal_number
        super().__init__(message)


class Child:
    """One worker process, leader of its own process group.

    In a group of its own, the worker does not receive Ctrl-C, and is ended together with every process it started.
    """

    def __init__(self, log: Path) -> None:
        """Start the process; `log` receives its output before the first job."""
        jobs, self._jobs = os.pipe()
        self._messages, messages = os.pipe()
        lifeline, self._lifeline = os.pipe()
        try:
            with log.open("ab") as output:
                self._process = subprocess.Popen(
                    [
                        sys.executable,
                        "-m",
                        "mrpbench_core.engine.processes.worker",
                        *map(str, (jobs, messages, lifeline)),
                    ],
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=output,
                    pass_fds=(jobs, messages, lifeline),
                    start_new_session=True,
                )
        except OSError:
            self._close_pipes()
            raise
        finally:
            for descriptor in (jobs, messages, lifeline):
                os.close(descriptor)
        self._buffer = b""
        self._poll = select.poll()
        self._poll.register(self._messages, select.POLLIN)
        self._reaping = threading.Lock()
        self._watched = psutil.Process(self._process.pid)
        self._next_sample = 0.0

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    def send(self, message: Mapping[str, Any]) -> None:
        """Hand over a job.

        Raises:
            WorkerDied: the process has ended.
        """
        content = json.dumps(message).encode() + b"\n"
        try:
            while content:
                content = content[os.write(self._jobs, content) :]
        except BrokenPipeError:
            raise self._end() from None

    def receive(self, timeout_s: float) -> dict[str, Any] | None:
        """The next message, or None when none came in time.

        Raises:
            WorkerDied: the process ended.
        """
        while b"\n" not in self._buffer:
            ended = self._ended()  # checked before reading, so that the last message is received
            if not self._poll.poll(0 if ended else timeout_s * 1000):
                if ended:
                    raise self._end()
                return None
            content = os.read(self._messages, 1 << 16)
            if not content:
                raise self._end()
            self._buffer += content
        line, _, self._buffer = self._buffer.partition(b"\n")
        message: dict[str, Any] = json.loads(line)
        return message

    def memory(self) -> int | None:
        """Resident bytes of the process and its descendants, or None when it is too early to measure again."""
        began = time.monotonic()
        if began < self._next_sample:
            return None
        total = 0
        with contextlib.suppress(psutil.NoSuchProcess):
            for process in (self._watched, *self._watched.children(recursive=True)):
                with contextlib.suppress(psutil.NoSuchProcess):
                    total += process.memory_info().rss
        now = time.monotonic()
        self._next_sample = now + max(SAMPLING_S, 20 * (now - began))
        return total

    def is_alive(self) -> bool:
        """Tell whether it still runs."""
        return not self._ended()

    def is_tidy(self, memory_bytes: int) -> bool:
        """Tell whether the process may execute another run: it holds little memory and left no program running."""
        started = Path(f"/proc/{self.pid}/task/{self.pid}/children")  # far cheaper than looking at every process
        try:
            busy = started.exists() and started.read_text().strip()
            return not busy and self._watched.memory_info().rss < memory_bytes
        except (OSError, psutil.Error):
            return False

    def kill(self) -> None:
        """End the process and everything it has started; may be called from any thread."""
        with self._reaping:
            if self._process.returncode is None:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(self.pid, signal.SIGKILL)

    def close(self) -> None:
        """Kill it and release its pipes."""
        self.kill()
        with self._reaping:
            self._process.wait()
        self._close_pipes()

    def _close_pipes(self) -> None:
        for descriptor in (self._jobs, self._messages, self._lifeline):
            os.close(descriptor)

    def _ended(self) -> bool:
        """Tell whether the process ended, without reaping it: until then its process id is not reused."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def _end(self) -> WorkerDied:
        """Return the exception that describes how the child ended."""
        deadline = time.monotonic() + CLOSING_S
        while not self._ended():
            if time.monotonic() > deadline:
                return WorkerDied("the worker process closed its connection")
            time.sleep(0.001)
        status = os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOWAIT)
        assert status is not None
        if status.si_code == os.CLD_EXITED:
            return WorkerDied(f"the worker process ended with exit code {status.si_status}")
        return WorkerDied(f"the worker process was ended by {signal.Signals(status.si_status).name}", status.si_status)
