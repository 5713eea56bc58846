"""Follows one job from its start to the end of its process, from outside of that process."""

import os
import select
import signal
import socket
import time
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.engine.processes.channel import Channel, ClosedError, GarbledError, new_key
from mrpbench_core.engine.processes.child import OUTSIDE
from mrpbench_core.engine.processes.fork_server import ForkServer
from mrpbench_core.engine.processes.limits import LimitMonitor
from mrpbench_core.engine.processes.machine import oom_kills
from mrpbench_core.engine.processes.output import cut
from mrpbench_core.engine.processes.process_tree import descendants, kill_descendants, resident_bytes
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.model.runs.status import RunStatus, Stage

Message = dict[str, Any]

SAMPLING_S = 0.05
"""Seconds between two measurements of memory and log, which messages do not delay.

The messages of a job are read when they come only after the first of these: most are not urgent, and a short run ends
before that.
"""
ENDING_S = 0.05
"""Seconds that a process may take to end after its answer, before it is killed."""
TELLING_S = 5.0
"""Seconds that a fork server may take to tell that a killed process has ended, before it is killed too."""
CLOSING_S = 1.0
"""Seconds from the end of a connection to the end of its process."""
ANSWERS = {"prepare": ("prepared", "record"), "drive": ("claims",), "judge": ("record",), "measure": ("measured",)}
"""The keys of the answers to each step, apart from failures."""
FAILURES = frozenset({RunStatus.CONTRACT_BROKEN, RunStatus.OUT_OF_MEMORY, RunStatus.CRASHED})
"""The statuses that a process may give the run instead of an answer."""


class Supervision:
    """The supervision of one job.

    Args:
        job: see `mrpbench_core.engine.processes.job.Job.message`.
        invoker: receives how far the job is.
        server: forks the process of the job.
        servers: process ids of all fork servers, which do not belong to the job.
    """

    def __init__(self, job: Message, invoker: Channel, server: ForkServer, servers: Collection[int]) -> None:
        self._log = Path(job["log"])
        self._invoker = invoker
        self._server = server
        self._servers = servers
        self._began = self._stage_began = time.monotonic()
        self._planning_s = 0.0
        self._answers = ANSWERS.get(job.get("step", ""), ())
        self._monitor = LimitMonitor(job["wall_s"], job["memory_bytes"])
        self._next_sample = time.monotonic() + SAMPLING_S
        self._oom_before = oom_kills()
        self._connection, theirs = socket.socketpair()
        self._closing: float | None = None
        self._forked = self._progressed = False
        key = new_key()
        self._channel = Channel(self._connection, key)
        self._poll = select.poll()
        for source in (invoker, server):
            self._poll.register(source, select.POLLIN)
        self._poll.register(self._connection, 0)  # its end only
        server.fork(theirs, job.get("instance_file", ""))
        theirs.close()
        with suppress(OSError, ClosedError):  # it has ended, which `run` finds
            self._connection.sendall(key)
            self._channel.send(job)

    def run(self) -> tuple[Message, bool]:
        """Return the answer, and whether the fork server still runs; afterwards no process of the job is left.

        Raises:
            ClosedError: the invoker closed its connection.
        """
        answer: Message | None = None
        status: int | None = None
        serves = True
        try:
            while answer is None and status is None and serves:
                ready = self._wait()
                if self._invoker.fileno() in ready:
                    raise ClosedError  # a second job never comes before the answer to the first
                answer = self._drain()
                if self._server.fileno() in ready and answer is None:
                    status, serves = self._heed()
                    answer = self._drain()
                answer = answer or self._exceeded()
        finally:
            if not self._forked:  # the server imports plugins without end, or has ended
                self._server.kill()
                serves = False
            if answer is not None and status is None and serves:
                status, serves = self._heed(ENDING_S)  # most processes end by themselves
            kill_descendants(self._servers)
            deadline = time.monotonic() + TELLING_S
            while status is None and serves:
                status, serves = self._heed(max(0.0, deadline - time.monotonic()))
                if status is None and serves and time.monotonic() >= deadline:  # a plugin stopped it
                    self._server.kill()
                    serves = False
            self._connection.close()
        if not serves:
            status = self._server.wait()
        assert status is not None
        answer = answer or self._died(status)
        if "claims" in answer:
            answer["outside"] = {"run_wall_s": time.monotonic() - self._began, "planning_s": self._planning_s}
        return answer, serves

    def _wait(self) -> set[int]:
        """Wait until something happens or is to be checked; return the descriptors that are ready."""
        waits = [self._next_sample - time.monotonic(), self._monitor.patience()]
        return {descriptor for descriptor, _ in self._poll.poll(max(0.0, min(waits)) * 1000)}

    def _drain(self) -> Message | None:
        """Read what the job says; return its answer."""
        try:
            while self._closing is None and (message := self._channel.receive(0)) is not None:
                if not self._forked:  # the server's imports are over, whether or not its messages were read
                    self._forked = True
                    self._monitor.importing(None)
                if (answer := self._take(message)) is not None:
                    return answer
        except (GarbledError, KeyError, TypeError, ValueError) as error:
            return self._failure(RunStatus.CRASHED, f"a plugin wrote to the connection of the engine: {error}")
        except ClosedError:
            self._poll.unregister(self._connection)
            self._closing = time.monotonic() + CLOSING_S
        return None

    def _note_planning(self) -> None:
        """Count the time since the last stage began, if that is the first call of the planner."""
        now = time.monotonic()
        if self._monitor.stage == Stage.PLANNING:
            self._planning_s += now - self._stage_began
        self._stage_began = now

    def _take(self, message: Message) -> Message | None:
        """Take one message; return the answer that it is."""
        if "progress" in message:
            self._invoker.send(message)
            self._progressed = True
        elif "stage" in message:
            self._note_planning()
            stage = Stage(message["stage"])
            self._monitor.enter(stage, message["at"], message.get("limit_s"), message.get("scenario_id"))
            if self._progressed:
                self._invoker.send({"progress": None})
            self._progressed = False
        elif "importing" in message:
            self._monitor.importing(message["importing"])
        elif "status" in message:
            if message["status"] not in FAILURES:
                raise ValueError(f"the status {message['status']!r:.40}")
            return self._failure(RunStatus(message["status"]), message["message"])
        else:
            if self._answers and not any(key in message for key in (*self._answers, "mistake")):
                raise ValueError("an answer to something else")
            if "record" in message:
                RunRecord.of_message(message["record"])  # the invoker will read it
            return message
        return None

    def _heed(self, timeout_s: float | None = None) -> tuple[int | None, bool]:
        """Wait for a message of the fork server: the wait status of the process if it ended, and whether it serves."""
        try:
            message = self._server.receive(timeout_s)
        except ClosedError:
            return None, False
        if message is None:
            return None, True
        if "importing" not in message:
            self._forked = True
        elif not self._forked:
            self._monitor.importing(message["importing"])
        return message.get("ended"), True

    def _exceeded(self) -> Message | None:
        """The failure of a job that exceeds a limit, or None."""
        failure = self._monitor.overrun()
        now = time.monotonic()
        if failure is None and self._closing is not None and now > self._closing:
            return self._failure(RunStatus.CRASHED, "the worker process closed its connection")
        if failure is None and now >= self._next_sample:
            if self._closing is None:
                self._poll.modify(self._connection, select.POLLIN)
            cut(self._log)
            held = sum(map(resident_bytes, descendants(os.getpid(), self._servers)))
            failure = self._monitor.overweight(max(held, resident_bytes(self._server.pid)))  # which may prepare the run
            self._next_sample = time.monotonic() + max(SAMPLING_S, 20 * (time.monotonic() - now))
        return None if failure is None else {"failure": attrs.asdict(failure)}

    def _died(self, status: int) -> Message:
        """The failure of a job whose process ended without an answer."""
        if os.WIFEXITED(status):
            code = os.WEXITSTATUS(status)
            return self._failure(RunStatus.CRASHED, f"the worker process ended with exit code {code}")
        number = os.WTERMSIG(status)
        if number == signal.SIGKILL and oom_kills() > self._oom_before:
            ended = f"the machine ran out of memory, and the kernel ended the run; {self._monitor.allowance}"
            return self._failure(RunStatus.OUT_OF_MEMORY, ended)
        ended = f"the worker process was ended by {signal.Signals(number).name}"
        return self._failure(RunStatus.CRASHED, ended, lost=number in OUTSIDE)

    def _failure(self, status: RunStatus, message: str, lost: bool = False) -> Message:
        return {"failure": attrs.asdict(self._monitor.failure(status, message, lost))}
