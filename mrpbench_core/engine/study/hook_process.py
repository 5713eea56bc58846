"""The process of one hook plugin during a study, a module that is run with one descriptor: its connection.

It sends a message when it has imported the plugin, and after each call of a hook.
"""

import logging
import signal
import socket
import sys

from mrpbench_core.engine.processes.channel import KEY_BYTES, Channel, ClosedError
from mrpbench_core.engine.processes.process_tree import end_with_parent
from mrpbench_core.plugins.hooks import Hooks
from mrpbench_core.plugins.installed import Provider


def main(descriptor: int) -> None:
    """Serve the invoker at the other end of a socket."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the invoker's
    logging.basicConfig(format="%(message)s", level=logging.WARNING)
    connection = socket.socket(fileno=descriptor)
    connection.set_inheritable(False)
    channel = Channel(connection, connection.recv(KEY_BYTES, socket.MSG_WAITALL))
    hooks = Hooks()
    try:
        while (message := channel.receive()) is not None:
            if "provider" in message:
                end_with_parent(message["parent"])
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
