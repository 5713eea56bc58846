"""The invoker's end of a supervisor process."""

import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from typing import Any

from mrpbench_core.engine.processes.channel import Channel, ClosedError, GarbledError, new_key
from mrpbench_core.files.removal import remove_tree

ENDING_S = 10.0
"""Seconds that a supervisor may take to kill its jobs and end."""
OUTSIDE = frozenset({signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP})
"""Signals that people and batch systems send, and that defects do not raise."""


class WorkerDied(Exception):  # noqa: N818 - it says what happened
    """The process ended without an answer; the message says how."""

    def __init__(self, message: str, signal_number: int | None = None) -> None:
        self.signal = signal_number
        super().__init__(message)


class Child:
    """One supervisor process. It is in a session of its own, so that it does not receive Ctrl-C."""

    def __init__(self) -> None:
        self._folder = tempfile.mkdtemp(prefix="mrpbench-")
        module, (ours, theirs) = "mrpbench_core.engine.processes.supervisor", socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", module, str(theirs.fileno()), self._folder],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                start_new_session=True,
            )
        key = new_key()
        ours.sendall(key)
        self._channel = Channel(ours, key)

    def send(self, message: Mapping[str, Any]) -> None:
        """Hand over a job.

        Raises:
            WorkerDied: the process has ended.
        """
        try:
            self._channel.send(message)
        except ClosedError:
            raise self._end() from None

    def receive(self, timeout_s: float | None = None) -> dict[str, Any] | None:
        """The next message, or None when none came in time.

        Raises:
            WorkerDied: the process ended.
        """
        try:
            return self._channel.receive(timeout_s)
        except (ClosedError, GarbledError):
            raise self._end() from None

    def is_alive(self) -> bool:
        """Tell whether it still runs."""
        return self._process.poll() is None

    def stop(self) -> None:
        """Let it end its job and itself; may be called from any thread."""
        self._channel.shut_down()

    def close(self) -> None:
        """End it, with its job if it has one."""
        self.stop()
        try:
            self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._channel.close()
        remove_tree(self._folder, ignore_errors=True)  # it does so itself unless it was killed

    def _end(self) -> WorkerDied:
        """The exception that says how the process ended."""
        try:
            code = self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            return WorkerDied("the supervisor process closed its connection")
        if code >= 0:
            return WorkerDied(f"the supervisor process ended with exit code {code}")
        return WorkerDied(f"the supervisor process was ended by {signal.Signals(-code).name}", -code)
