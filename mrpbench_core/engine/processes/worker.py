"""Executes one job in a process of its own, which a fork server has forked for it.

Plugins run here. What they print, in Python or in native code, goes to the run's log.
"""

import errno
import faulthandler
import importlib
import os
import resource
import socket
import tempfile
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.blame import broken, owner_of
from mrpbench_core.engine.json_values import jsonable
from mrpbench_core.engine.loading.runs import pack_error
from mrpbench_core.engine.processes.channel import KEY_BYTES, Channel
from mrpbench_core.engine.processes.output import append_to, flush
from mrpbench_core.engine.processes.process_tree import address_space, prefer_to_end
from mrpbench_core.engine.processes.steps import STEPS, State
from mrpbench_core.files.disk import is_full
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.printing import printable
from mrpbench_core.model.runs.status import RunStatus
from mrpbench_core.plugins.importing import tell_imports
from mrpbench_core.plugins.provenance import title


def execute_job(connection: socket.socket, state: State, executed: Callable[[], None]) -> None:
    """Receive a job, execute it, and send its answer; call `executed` before."""
    connection.set_inheritable(False)  # programs that a plugin starts must not keep it open
    prefer_to_end()
    channel = Channel(connection, connection.recv(KEY_BYTES, socket.MSG_WAITALL))
    job = channel.receive()
    assert job is not None
    append_to(job["log"])
    tell_imports(lambda plugin: channel.send({"importing": plugin}))
    if "call" in job:
        if not os.environ.get("MRPBENCH_TRACEBACK"):
            faulthandler.disable()  # its output would be that of the command
        os.chdir(job["folder"])
        answer = _call(job["call"], job["arguments"])
    else:
        answer = _step(job, channel, state)
    flush()
    executed()
    try:
        channel.send(answer)
    except (TypeError, ValueError, RecursionError) as error:  # what a plugin declares may not be data
        channel.send({"raised": describe(error)})


def _call(function: str, arguments: list[Any]) -> dict[str, Any]:
    """Call `module:function`; return its result, or the user's mistakes that it found."""
    module, _, name = function.partition(":")
    try:
        return {"returned": getattr(importlib.import_module(module), name)(*arguments)}
    except InputErrors as several:
        return {"errors": list(map(pack_error, several.errors))}
    except InputError as error:
        return {"error": pack_error(error)}
    except BaseException as error:  # noqa: BLE001 - a plugin may raise anything, even SystemExit
        if os.environ.get("MRPBENCH_TRACEBACK"):
            traceback.print_exc()
        return {"raised": describe(error)}


def _step(job: dict[str, Any], channel: Channel, state: State) -> dict[str, Any]:
    """Do one step of a run; return its answer."""
    try:
        os.environ["TMPDIR"] = tempfile.tempdir = job["temporary"]
        _backstop(job["memory_bytes"])
        return _guarded(job, channel, state)
    except OSError as error:
        return {"mistake": f"{job['log']}: {error.strerror}"}


def _guarded(job: dict[str, Any], channel: Channel, state: State) -> dict[str, Any]:
    try:
        return STEPS[job["step"]](job, channel, state)
    except (InputError, InputErrors) as error:
        return {"mistake": jsonable(str(error))}
    except BrokenContractError as error:
        _print_exception()
        return {"status": RunStatus.CONTRACT_BROKEN, "message": printable(broken(error, state.config))}
    except MemoryError as error:
        _print_exception()
        held = f"the process held {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10:.0f} MiB"
        allowed = (
            ""
            if state.config is None
            else f"; the option limits.memory allows {state.config.limits.memory / 2**20:.0f} MiB"
        )
        message = f"{printable(str(error)) or 'no memory left'} ({held}{allowed})"
        return {"status": RunStatus.OUT_OF_MEMORY, "message": message}
    except BaseException as error:  # noqa: BLE001 - a plugin may raise anything, even SystemExit
        if is_full(error) and not _limits_files():  # the run is to be done again
            return {"mistake": f"{job['recording']}: cannot be written: {jsonable(printable(str(error)))}"}
        _print_exception()
        return {"status": RunStatus.CRASHED, "message": describe(error, state.config)}


def describe(error: BaseException, config: RunConfig | None = None) -> str:
    """One line: what was raised, the innermost place outside the core, and the component to which it belongs."""
    try:
        text = printable(str(error))[:300]
    except BaseException:  # noqa: BLE001 - which is code of the plugin, too
        text = ""
    frames = traceback.extract_tb(error.__traceback__)
    inside = str(Path(__file__).parents[2]), "<"  # attrs compiles without a file
    outside = [frame for frame in frames if not frame.filename.startswith(inside)]
    place = next(reversed(outside or frames[-1:]), None)
    owner = None if config is None else owner_of(error, config)
    of = "" if owner is None else f", in the {printable(title(owner))}"
    where = "" if place is None else f" ({Path(place.filename).name}:{place.lineno})"
    return f"{type(error).__name__}{': ' + text if text else ''}{where}{of}"


def _print_exception() -> None:
    """Print the traceback into the log, if the plugin left one that can be written."""
    try:
        traceback.print_exc()
    except OSError as error:
        if error.errno != errno.EBADF and not _limits_files():
            raise


def _limits_files() -> bool:
    """Tell whether a plugin has changed how large files may be: it would do so in each run, other than a full disk."""
    return resource.getrlimit(resource.RLIMIT_FSIZE) != resource.prlimit(os.getppid(), resource.RLIMIT_FSIZE)


def _backstop(memory_bytes: int) -> None:
    """Refuse a single huge allocation, which sampling would notice too late.

    Far above the limit: address space is much more than memory where threads and mapped files are.
    """
    limit = address_space() + 4 * memory_bytes + 8 * 2**30
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))
