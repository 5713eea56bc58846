"""A fork server: a process that has imported the plugins of a configuration, and forks a fresh process for each run.

Each run starts from the same state: what the plugins did when they were imported, and nothing that another run did.

A *resident* server imports no plugins of others and executes its jobs itself, one after another, because a process for
each would take longer than most of these jobs.
"""

import functools
import gc
import importlib
import itertools
import os
import signal
import socket
import sys
import traceback
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, NoReturn, Self

import numpy as np

from mrpbench_core.engine.processes.channel import Channel, ClosedError, GarbledError, new_key
from mrpbench_core.engine.processes.output import flush, redirect
from mrpbench_core.engine.processes.process_tree import end_with_parent
from mrpbench_core.engine.processes.steps import State
from mrpbench_core.engine.processes.warm_up import warm_up
from mrpbench_core.plugins.hooks import load_hooks
from mrpbench_core.plugins.importing import tell_imports

Execute = Callable[[socket.socket, State, Callable[[], None]], None]
"""Receives a job from a connection, executes it, calls its last argument and answers."""
_NAMES = 1 << 15
"""Bytes of module names, less than a pipe holds."""


class ForkServer:
    """A fork server, as the process that started it sees it."""

    def __init__(self, pid: int, connection: socket.socket, key: bytes) -> None:
        self.pid = pid
        self.connection = connection
        self.jobs = 0
        """The number of jobs that it was given."""
        self._channel = Channel(connection, key)

    @classmethod
    def start(
        cls, job: Mapping[str, Any], execute: Execute, inherited: Sequence[socket.socket], *, resident: bool
    ) -> Self:
        """Start a server for jobs with the plugins of `job`; it closes the sockets that it inherits.

        These must be all of this process, also those of other servers: a server ends when its connection has no other
        end, and a plugin must not write to the connection of another server.
        """
        ours, theirs = socket.socketpair()
        parent, key = os.getpid(), new_key()
        pid = os.fork()
        if pid == 0:
            try:
                end_with_parent(parent)
                for connection in (ours, *inherited):
                    connection.close()
                _serve(theirs, Channel(theirs, key), job, execute, resident)
            except BaseException:  # noqa: BLE001 - as below
                with suppress(Exception):  # a plugin closed standard error
                    traceback.print_exc()
            finally:  # nothing of the parent's stack may run in this process
                os._exit(1)
        theirs.close()
        return cls(pid, ours, key)

    def fileno(self) -> int:
        """Readable when there is a message, or the server has ended."""
        return self.connection.fileno()

    def fork(self, connection: socket.socket, instance: str = "") -> None:
        """Fork a process that executes the job of `connection`, with an instance that is read before."""
        self.jobs += 1
        with suppress(OSError):  # it has ended, which `receive` tells
            socket.send_fds(self.connection, [instance.encode() or b"-"], [connection.fileno()])

    def receive(self, timeout_s: float | None = None) -> dict[str, Any] | None:
        """The next message: `importing`, a plugin or None; or `ended`, the wait status of the forked process.

        Raises:
            ClosedError: the server has ended.
        """
        try:
            return self._channel.receive(timeout_s)
        except GarbledError as error:
            raise ClosedError from error

    def kill(self) -> None:
        """End it at once."""
        os.kill(self.pid, signal.SIGKILL)

    def wait(self) -> int:
        """The wait status of the server itself, which has ended or ends now."""
        self.connection.close()
        return os.waitpid(self.pid, 0)[1]


def _serve(
    connection: socket.socket, channel: Channel, job: Mapping[str, Any], execute: Execute, resident: bool
) -> NoReturn:
    redirect(job["log"])
    for number in (signal.SIGTERM, signal.SIGINT):  # from outside, which is not an exception of a plugin
        signal.signal(number, signal.SIG_DFL)
    os.setsid()  # Ctrl-C reaches the invoker only
    tell_imports(lambda plugin: channel.send({"importing": plugin}))
    state = State()
    if "step" in job and not resident:
        warm_up()
    if job.get("step") == "drive":
        state.hooks = load_hooks()
        with suppress(Exception):  # the run reports it
            state.unpack(job["parcel"])
    flush()
    server = os.getpid()
    while resident:
        _, descriptors, _, _ = socket.recv_fds(connection, _NAMES, 1)
        if not descriptors:  # the supervisor closed its end
            os._exit(0)
        execute(socket.socket(fileno=descriptors[0]), state, lambda: None)
        channel.send({"ended": 0})
    while True:
        words = np.frombuffer(os.urandom(4 * 624), np.uint32)
        np.random.set_state(("MT19937", words, 624, 0, 0.0))  # noqa: NPY002 - other random numbers for plugins in each process
        gc.freeze()  # collections in the forked processes then leave the shared memory alone
        name, descriptors, _, _ = socket.recv_fds(connection, _NAMES, 1)
        if not descriptors:
            os._exit(0)
        state.read(name.decode())
        imported, writer = os.pipe()
        pid = os.fork()
        if pid == 0:
            end_with_parent(server)
            connection.close()
            os.close(imported)
            os.set_inheritable(writer, False)
            tell = functools.partial(_tell, writer, len(sys.modules))
            execute(socket.socket(fileno=descriptors[0]), state, tell)
            os._exit(0)
        os.close(descriptors[0])
        os.close(writer)
        channel.send({"ended": os.waitpid(pid, 0)[1]})
        _import(imported)
        os.close(imported)


def _tell(descriptor: int, before: int) -> None:
    """Write the names of the modules that this process has imported since there were `before`."""
    if len(sys.modules) == before:  # the usual case: to read the names would copy the pages on which they are
        return
    with suppress(OSError):  # a plugin closed it
        os.write(descriptor, " ".join(itertools.islice(sys.modules, before, None)).encode()[:_NAMES])


def _import(descriptor: int) -> None:
    """Import what a run imported, so that the next one need not."""
    os.set_blocking(descriptor, False)
    with suppress(OSError):
        for name in os.read(descriptor, _NAMES).decode(errors="replace").split():
            with suppress(Exception, SystemExit):
                importlib.import_module(name)
            flush()
