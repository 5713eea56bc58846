"""The child process of a worker slot, a module that is run with three descriptors: JOBS MESSAGES LIFELINE.

Reads one job a line and executes it, announcing each stage. What plugins print, in Python or in native code, goes to
the run's log.
"""

import contextlib
import ctypes
import faulthandler
import json
import os
import resource
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil

from mrpbench_core.config.study import unpack
from mrpbench_core.engine.json_values import jsonable, printable
from mrpbench_core.engine.observers import Observers
from mrpbench_core.engine.pipeline import execute
from mrpbench_core.engine.processes.lifeline import tie_to_invoker
from mrpbench_core.engine.processes.machine import machine
from mrpbench_core.files.disk import is_full
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.plugins.hooks import Hooks, load_hooks
from mrpbench_core.store.paths import RunPaths

Send = Callable[[dict[str, Any]], None]


def main(jobs: int, messages: int, lifeline: int) -> None:
    """Execute jobs until the slot closes its end."""
    tie_to_invoker(lifeline)
    for descriptor in (jobs, messages):  # programs that a plugin starts must not keep them open
        os.set_inheritable(descriptor, False)
    Path("/proc/self/oom_score_adj").write_text("500")  # the kernel is to end a worker, never the invoker
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(line_buffering=True, errors="backslashreplace")  # type: ignore[union-attr]
    faulthandler.enable()
    hooks = load_hooks()
    with os.fdopen(jobs, "rb") as requests, os.fdopen(messages, "wb", buffering=0) as replies:

        def say(message: dict[str, Any]) -> None:
            replies.write(json.dumps(message).encode() + b"\n")

        say({"ready": True, "machine": machine()})
        for line in requests:
            hooks.enable()
            say(_answer(json.loads(line), say, hooks))


def _answer(job: dict[str, Any], say: Send, hooks: Hooks) -> dict[str, Any]:
    """Execute a job with a log of its own, which is kept only if something was printed."""
    log = Path(job["log"])
    try:
        _redirect(log)
        _backstop(job["memory_bytes"])
        answer = _execute(job, say, hooks)
        _flush()
        _redirect(Path(os.devnull))
        if not log.stat().st_size:
            log.unlink()
    except OSError as error:
        return {"mistake": f"{log}: {error.strerror}"}
    return answer


def _execute(job: dict[str, Any], say: Send, hooks: Hooks) -> dict[str, Any]:
    def announce(name: Stage, facts: dict[str, Any]) -> None:
        say({"stage": name, **jsonable(facts)})

    paths = RunPaths(
        recording=Path(job["recording"]),
        exports=Path(job["exports"]),
        picture=None if job["picture"] is None else Path(job["picture"]),
    )
    observers = Observers(
        planned=lambda problem, result: hooks.call("mrpbench_planned", problem=problem, result=result),
        executing=lambda context: hooks.call("mrpbench_executing", context=context),
        stepped=lambda **seen: hooks.call("mrpbench_stepped", **seen),
        executed=lambda: hooks.call("mrpbench_executed"),
        progress=lambda **facts: say({"progress": facts}),
    )
    try:
        record = jsonable(execute(unpack(job["parcel"]), job["run_id"], paths, announce, observers).message())
    except (InputError, InputErrors) as error:
        return {"mistake": jsonable(str(error))}
    except MemoryError as error:
        traceback.print_exc()
        return {"status": RunStatus.OUT_OF_MEMORY, "message": printable(str(error)) or "no memory left"}
    except BaseException as error:  # noqa: BLE001 - a plugin may raise anything, even SystemExit
        if is_full(error):  # the run is to be done again
            return {"mistake": f"{job['recording']}: cannot be written: {jsonable(printable(str(error)))}"}
        traceback.print_exc()
        return {"status": RunStatus.CRASHED, "message": describe(error)}
    return {"record": record}


def describe(error: BaseException) -> str:
    """One line: what was raised, and the innermost place outside the core."""
    text = printable(str(error))[:300]
    frames = traceback.extract_tb(error.__traceback__)
    own = str(Path(__file__).parents[2]), "<"  # attrs compiles without a file
    outside = [frame for frame in frames if not frame.filename.startswith(own)]
    place = next(reversed(outside or frames[-1:]), None)
    where = "" if place is None else f" ({Path(place.filename).name}:{place.lineno})"
    return f"{type(error).__name__}{': ' + text if text else ''}{where}"


def _redirect(file: Path) -> None:
    target = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND, 0o644)
    os.dup2(target, 1)
    os.dup2(target, 2)
    os.close(target)


def _flush() -> None:
    """Empty Python's and the C library's buffers, so that each run's output is in its own log."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(ValueError):  # a plugin closed it
            stream.flush()
    ctypes.CDLL(None).fflush(None)


def _backstop(memory_bytes: int) -> None:
    """Refuse a single huge allocation, which sampling would notice too late.

    Far above the limit: address space is much more than memory where threads and mapped files are.
    """
    limit = psutil.Process().memory_info().vms + 4 * memory_bytes + 8 * 2**30
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
