"""Runs a program, and all processes that it starts, within limits of time and memory."""

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
"""Interval between two measurements at the start; it grows to ten times that."""


@attrs.frozen
class Ended:
    """The end of a program: by itself, or by one of the limits."""

    code: int
    """Exit code, negative: killed by that signal."""
    limit: str | None
    """time | memory | None."""
    seconds: float
    cpu_s: float
    """CPU time of the program and of the processes that it waited for."""
    resident: int
    """Largest measured memory of the program and of all processes that it started, in bytes."""
    output: str


def run(command: Sequence[str], folder: Path, wall_s: float, memory_bytes: int) -> Ended:
    """Run `command` in `folder`; kill it and all processes that it started when it exceeds a limit.

    Raises:
        OSError: the program cannot be started.
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
    """CPU time of all programs that have ended so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _wait(process: "subprocess.Popen[bytes]", deadline: float, memory_bytes: int) -> tuple[str | None, int]:
    """Wait until the program ends or exceeds a limit; return that limit, if any, and the largest measured memory."""
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
    except psutil.Error:  # the process has just ended
        pass
    return total


def _kill(process: "subprocess.Popen[bytes]") -> None:
    """Kill its process group, and descendants that left the group."""
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
