"""Calls a function of the core in a worker process, where plugins may be imported."""

import os
import sys
from collections.abc import Callable
from typing import Any

import psutil

from mrpbench_core.engine.loading.runs import unpack_error
from mrpbench_core.engine.processes.child import WorkerDied
from mrpbench_core.engine.processes.slots import ask_in_slot, slots_of_this_process
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.runs.status import RunStatus

LIMIT_S = 120.0
"""Wall seconds that a call may take by default."""
MEMORY = 4 * 2**30
"""Bytes that the processes of one call may hold."""
COMMAND_S = 24 * 3600.0
"""Wall seconds that the work of a command may take; Ctrl-C ends it earlier."""


class CallFailedError(Exception):
    """The call has no result; the message says why."""

    def __init__(self, message: str, *, late: bool = False) -> None:
        super().__init__(message)
        self.late = late
        """It was ended because of its time limit."""


def call(
    slots: str, function: Callable[..., Any], *arguments: Any, limit_s: float = LIMIT_S, memory_bytes: int = MEMORY
) -> Any:
    """Call a function of a module in a fresh process of `slots`; arguments and result are plain data.

    What plugins print there goes to standard error.

    Raises:
        CallFailedError: there is no process, it crashed, or it exceeded a limit.
        InputError, InputErrors: the function found mistakes of the user.
    """
    job = {
        "call": f"{function.__module__}:{function.__qualname__}",
        "arguments": arguments,
        "folder": os.getcwd(),  # noqa: PTH109
        "wall_s": limit_s,
        "memory_bytes": memory_bytes,
    }
    try:
        answer = ask_in_slot(slots, job)
    except (WorkerDied, OSError, TypeError, ValueError) as error:  # the last two: arguments that are no plain data
        raise CallFailedError(str(error)) from error
    sys.stderr.write(answer.get("printed", ""))  # a plugin's output is not part of ours
    if "failure" in answer:
        late = answer["failure"]["status"] == RunStatus.WALL_TIMEOUT
        message = str(answer["failure"]["message"]).replace("limits.memory allows", "allowed are")
        raise CallFailedError(f"did not end within {limit_s:g} s and was ended" if late else message, late=late)
    if "raised" in answer:
        raise CallFailedError(answer["raised"])
    if "error" in answer:
        raise unpack_error(answer["error"])
    if "errors" in answer:
        raise InputErrors(*map(unpack_error, answer["errors"]))
    return answer.get("returned")


def in_worker(failed: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call the part of a command that imports plugins; see `call`. All memory of the machine is allowed.

    Raises:
        InputError: the call failed: `failed`, and why; or the function found a mistake of the user.
        InputErrors: the function found several.
    """
    memory = psutil.virtual_memory().total
    with slots_of_this_process() as slots:
        try:
            return call(slots, function, *arguments, limit_s=COMMAND_S, memory_bytes=memory)
        except CallFailedError as failure:
            raise InputError(f"{failed}: {failure}") from failure
