"""Facts about the machine that executes runs, for the record."""

import os
import platform
from functools import cache
from pathlib import Path
from typing import Any

import psutil


@cache
def machine() -> dict[str, Any]:
    """Node, system, processor, its number of cores that this process may use, memory and Python."""
    return {
        "node": platform.node(),
        "system": f"{platform.system()} {platform.release()}",
        "libc": "-".join(platform.libc_ver()),
        "processor": _processor(),
        "cores": len(os.sched_getaffinity(0)),
        "memory_bytes": psutil.virtual_memory().total,
        "python": platform.python_version(),
    }


def oom_kills() -> int:
    """The number of processes that the kernel has ended since boot for lack of memory."""
    try:
        return int(Path("/proc/vmstat").read_bytes().partition(b"\noom_kill ")[2].split(maxsplit=1)[0])
    except (OSError, IndexError):
        return 0


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
