"""Runs a program within limits of time and memory, with all it starts."""

import contextlib
import os
import resource
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

import attrs
import psutil

_GLANCE_S = 0.005
"""How often the program is looked at, at first; up to ten times that later."""


@attrs.frozen
class Ended:
    """How a program ended: by itself, or by one of the limits."""

    code: int
    """Exit code, negative: killed by that signal."""
    limit: str | None
    """time | memory | None."""
    seconds: float
    cpu_s: float
    """Of it and all that it waited for."""
    resident: int
    """The most bytes that it and all it started were seen to use."""
    output: str


def run(command: Sequence[str], folder: Path, wall_s: float, memory_bytes: int) -> Ended:
    """Run `command` in `folder`; when a limit is passed, it and all that it started are killed.

    Raises:
        OSError: it cannot be started.
    """
    began, began_cpu = time.monotonic(), _cpu_s()
    with (folder / "output.txt").open("w+b") as output:
        process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, process_group=0
        )
        try:
            limit, resident = _wait(process, began + wall_s, memory_bytes)
        finally:
            _kill(process)
        seconds = time.monotonic() - began
        output.seek(0)
        return Ended(
            process.returncode, limit, seconds, _cpu_s() - began_cpu, resident, output.read().decode(errors="replace")
        )


def _cpu_s() -> float:
    """Of all programs that were run so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _wait(process: "subprocess.Popen[bytes]", deadline: float, memory_bytes: int) -> tuple[str | None, int]:
    """Wait until the program has ended or passed a limit, and say which; and how much memory it was seen to use."""
    pause, most = _GLANCE_S, 0
    while True:
        left = deadline - time.monotonic()
        if left <= 0:
            return "time", most
        try:
            process.wait(min(pause, left))
        except subprocess.TimeoutExpired:
            pause = min(pause * 1.5, 10 * _GLANCE_S)
        else:
            return None, most
        most = max(most, _resident(process.pid))
        if most > memory_bytes:
            return "memory", most


def _resident(pid: int) -> int:
    total = 0
    try:
        family = psutil.Process(pid)
        for member in (family, *family.children(recursive=True)):
            total += member.memory_info().rss
    except psutil.Error:  # it has just ended
        pass
    return total


def _kill(process: "subprocess.Popen[bytes]") -> None:
    """Its group, and also who left the group but still descends from it."""
    family: list[psutil.Process] = []
    if process.poll() is None:
        with contextlib.suppress(psutil.Error):
            family = psutil.Process(process.pid).children(recursive=True)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    for member in family:
        with contextlib.suppress(psutil.Error):
            member.kill()
    process.wait()
