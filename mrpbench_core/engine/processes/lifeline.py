"""A worker ends when its invoker ends, even by `kill -9` and even while it is busy in native code.

The invoker holds the writing end of a pipe on which nothing is ever written. The kernel is asked to send SIGKILL to the
worker's process group when that end closes (`O_ASYNC` with `F_SETSIG`, see open(2) and fcntl(2)). A watching thread
would not do, since a plugin that holds the GIL would hold it up; neither would `PR_SET_PDEATHSIG`, which strikes when
the *thread* that started the child ends and spares the programs that a plugin has started.
"""

import fcntl
import os
import select
import signal


def tie_to_invoker(descriptor: int) -> None:
    """Tie this process group to the reading end of the invoker's pipe."""
    os.set_inheritable(descriptor, False)
    fcntl.fcntl(descriptor, fcntl.F_SETOWN, -os.getpgrp())
    fcntl.fcntl(descriptor, fcntl.F_SETSIG, signal.SIGKILL)
    fcntl.fcntl(descriptor, fcntl.F_SETFL, fcntl.fcntl(descriptor, fcntl.F_GETFL) | os.O_ASYNC)
    poll = select.poll()
    poll.register(descriptor, 0)
    if poll.poll(0):  # the invoker ended before this was armed
        os.killpg(0, signal.SIGKILL)
