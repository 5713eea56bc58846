"""The process of one hook plugin during a study, a module that is run with one descriptor: its connection.

It sends a message when it has imported the plugin, and after each call of a hook. The plugin runs in a child of it, and
all that it starts ends with that.
"""

import logging
import os
import signal
import socket
import sys
from contextlib import suppress

from mrpbench_core.engine.processes.channel import KEY_BYTES, Channel, ClosedError
from mrpbench_core.engine.processes.process_tree import (
    become_subreaper,
    end_with_parent,
    kill_descendants,
    prefer_to_end,
)
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.plugins.installed import Provider


def main(descriptor: int) -> None:
    """Let a child serve the invoker at the other end of a socket; end as it does, after its descendants."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the invoker's
    end_with_parent(os.getppid())
    become_subreaper()
    keeper = os.getpid()
    child = os.fork()
    if child == 0:
        end_with_parent(keeper)
        prefer_to_end()
        try:
            _serve(descriptor)
        except Exception:  # noqa: BLE001 - a plugin changed what this relies on; the invoker says that it ended
            sys.exit(1)
        return
    os.close(descriptor)
    signal.signal(signal.SIGTERM, lambda *_: _kill(child))
    status = os.waitpid(child, 0)[1]
    kill_descendants()
    if os.WIFSIGNALED(status):
        with suppress(OSError):  # of SIGKILL
            signal.signal(os.WTERMSIG(status), signal.SIG_DFL)
        os.kill(keeper, os.WTERMSIG(status))
    sys.exit(os.waitstatus_to_exitcode(status))


def _kill(child: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(child, signal.SIGKILL)


def _serve(descriptor: int) -> None:
    logging.basicConfig(format="%(message)s", level=logging.WARNING)
    connection = socket.socket(fileno=descriptor)
    connection.set_inheritable(False)
    channel = Channel(connection, connection.recv(KEY_BYTES, socket.MSG_WAITALL))
    hooks = Hooks()
    try:
        while (message := channel.receive()) is not None:
            if "provider" in message:
                hooks.load(Provider(**message["provider"]))
            else:
                if message["hook"] == "mrpbench_run_started":
                    hooks.enable()
                hooks.call(message["hook"], **message["arguments"])
            channel.send({})
    except ClosedError:
        return


if __name__ == "__main__":
    main(int(sys.argv[1]))
