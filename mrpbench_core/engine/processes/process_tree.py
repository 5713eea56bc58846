"""The processes that descend from this one, by Linux's `/proc` and `prctl(2)`.

A subreaper adopts each descendant whose parent ends, so that no descendant leaves the tree, whatever session or process
group it creates.
"""

import ctypes
import os
import signal
import time
from collections.abc import Collection, Iterator
from pathlib import Path

import psutil

_SET_PDEATHSIG, _SET_CHILD_SUBREAPER = 1, 36  # linux/prctl.h
_PAGE = os.sysconf("SC_PAGE_SIZE")
_LIBC = ctypes.CDLL(None, use_errno=True)
_LISTED = Path(f"/proc/self/task/{os.getpid()}/children").exists()  # a kernel may be built without CONFIG_PROC_CHILDREN

ENDING_S = 5.0
"""Seconds until the end of killed processes is no longer awaited: one that waits for a device cannot end."""


def become_subreaper() -> None:
    """Adopt the descendants of this process whose parents end."""
    _prctl(_SET_CHILD_SUBREAPER, 1)


def end_with_parent(parent: int) -> None:
    """Let the kernel kill this process when the process `parent` ends; `parent` has a single thread that forks."""
    _prctl(_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it ended before
        os.kill(os.getpid(), signal.SIGKILL)


def prefer_to_end() -> None:
    """Let the kernel end this process, or one that it starts, rather than others when memory is short."""
    descriptor = os.open("/proc/self/oom_score_adj", os.O_WRONLY | os.O_CLOEXEC)
    try:
        os.write(descriptor, b"500")
    finally:
        os.close(descriptor)


def descendants(pid: int, spared: Collection[int] = ()) -> Iterator[int]:
    """Yield all descendants of a process; those in `spared` are left out, but not their descendants."""
    waiting = _children(pid)
    while waiting:
        child = waiting.pop()
        waiting += _children(child)
        if child not in spared:
            yield child


def resident_bytes(pid: int) -> int:
    """Resident memory of a process, 0 if it has ended."""
    try:
        return int(_read(f"/proc/{pid}/statm").split()[1]) * _PAGE
    except OSError:
        return 0


def address_space() -> int:
    """Bytes of address space of this process."""
    return int(_read("/proc/self/statm").split()[0]) * _PAGE


def kill_descendants(spared: Collection[int] = ()) -> bool:
    """Kill and reap all descendants of this process, except those in `spared`; tell whether all have ended."""
    deadline = time.monotonic() + ENDING_S
    while alive := list(descendants(os.getpid(), spared)):
        if time.monotonic() > deadline:
            return False
        for pid in alive:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
        reap(spared)
        time.sleep(0.0005)
    return True


def reap(spared: Collection[int]) -> None:
    """Reap the children of this process that have ended, except those in `spared`."""
    for child in _children(os.getpid()):
        if child not in spared:
            os.waitpid(child, os.WNOHANG)


def _children(pid: int) -> list[int]:
    """The children of all threads of a process."""
    children: list[int] = []
    try:
        if not _LISTED:
            return [child.pid for child in psutil.Process(pid).children()]
        for thread in os.listdir(f"/proc/{pid}/task"):  # noqa: PTH208 - called for every run
            children += map(int, _read(f"/proc/{pid}/task/{thread}/children").split())
    except (OSError, psutil.Error):  # it has just ended
        pass
    return children


def _read(file: str) -> bytes:
    """The content of a file of `/proc`, many times for each run: `Path` takes twice as long."""
    descriptor = os.open(file, os.O_RDONLY | os.O_CLOEXEC)
    try:
        return os.read(descriptor, 1 << 16)
    finally:
        os.close(descriptor)


def _prctl(option: int, value: int) -> None:
    if _LIBC.prctl(option, value, 0, 0, 0) != 0:
        error = ctypes.get_errno()
        raise OSError(error, os.strerror(error))
