"""The supervisor process of a worker slot, a module that is run with a descriptor, its connection to the invoker, and a
folder for temporary files, which both remove.

It executes one job after another, each in a fresh process, and never a plugin. It adopts every process that a job
leaves behind, and kills the whole tree when the job ends, when it exceeds a limit, and when the invoker ends.
"""

import os
import signal
import socket
import sys
import tempfile
from collections import OrderedDict
from pathlib import Path
from typing import Any, NoReturn

from mrpbench_core.engine.processes.channel import KEY_BYTES, Channel, ClosedError
from mrpbench_core.engine.processes.fork_server import ForkServer
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.engine.processes.output import cut, remove_empty
from mrpbench_core.engine.processes.process_tree import become_subreaper, kill_descendants
from mrpbench_core.engine.processes.run_steps import OURS, run_in_steps
from mrpbench_core.engine.processes.supervision import Supervision
from mrpbench_core.engine.processes.worker import execute_job
from mrpbench_core.files.removal import remove_tree

SERVERS = 5
"""Fork servers that are kept, the most recently used ones."""
JOBS = 500
"""Jobs after which the resident server is replaced by a fresh one."""


class Supervisor:
    """Executes jobs until the invoker closes the connection."""

    def __init__(self, connection: socket.socket, folder: str) -> None:
        self._connection = connection
        self._invoker = Channel(connection, connection.recv(KEY_BYTES, socket.MSG_WAITALL))
        self._folder = folder
        self._servers: OrderedDict[str, ForkServer] = OrderedDict()

    def serve(self) -> None:
        """Answer one job after another."""
        try:
            self._invoker.send({"machine": machine()})
            while (job := self._invoker.receive()) is not None:
                self._invoker.send(self._answer(job))
        except ClosedError:
            return
        finally:
            kill_descendants()

    def _answer(self, job: dict[str, Any]) -> dict[str, Any]:
        """Execute a job; return its answer, with what plugins printed if the job names no file for it."""
        log = Path(job.get("log") or Path(self._folder, "log.txt"))
        try:
            log.unlink(missing_ok=True)
            log.touch()
        except OSError as error:
            return {"mistake": f"{log}: {error.strerror}"}
        try:
            temporary = tempfile.mkdtemp(prefix="run-", dir=self._folder)
        except OSError as error:
            return {"mistake": f"no temporary folder: {error.strerror}"}
        try:
            answer = self._execute({**job, "log": str(log), "temporary": temporary}, log)
            if "log" not in job and log.exists():
                answer["printed"] = log.read_text(errors="replace")
            return answer
        finally:
            try:
                os.rmdir(temporary)  # noqa: PTH106 - called for every run
            except OSError:
                remove_tree(temporary, ignore_errors=True)

    def _execute(self, job: dict[str, Any], log: Path) -> dict[str, Any]:
        answer = self._ask(job, "") if "call" in job else run_in_steps(job, self._ask)
        cut(log)
        remove_empty(log)
        return answer

    def _ask(self, job: dict[str, Any], plugins: str) -> dict[str, Any]:
        """Let a process do a job that the fork server of these plugins forks, or the resident one itself."""
        if plugins == OURS and plugins in self._servers and self._servers[plugins].jobs >= JOBS:
            self._servers.pop(plugins).wait()
        if plugins not in self._servers:
            while len(self._servers) >= SERVERS:
                self._servers.popitem(last=False)[1].wait()
            inherited = [self._connection, *(server.connection for server in self._servers.values())]
            self._servers[plugins] = ForkServer.start(job, execute_job, inherited, resident=plugins == OURS)
        self._servers.move_to_end(plugins)
        pids = {server.pid for server in self._servers.values()}
        answer, serves = Supervision(job, self._invoker, self._servers[plugins], pids).run()
        if not serves:
            del self._servers[plugins]
        return answer


def main(descriptor: int, folder: str) -> None:
    """Serve the invoker at the other end of a socket, with temporary files in a folder."""
    become_subreaper()
    connection = socket.socket(fileno=descriptor)
    connection.set_inheritable(False)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, _terminate)
    ended_by = None
    try:
        Supervisor(connection, folder).serve()
    except _TerminatedError as termination:
        ended_by = termination.number
    remove_tree(folder, ignore_errors=True)
    if ended_by is not None:
        signal.signal(ended_by, signal.SIG_DFL)
        os.kill(os.getpid(), ended_by)


class _TerminatedError(BaseException):
    """A signal that ends the process was received."""

    def __init__(self, number: int) -> None:
        self.number = number


def _terminate(number: int, frame: object) -> NoReturn:  # noqa: ARG001
    raise _TerminatedError(number)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
