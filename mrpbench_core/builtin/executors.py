"""Executors on this machine: `serial` and `processes`.

Both hand out threads. What a thread is given to call drives one supervised worker process, so that a plugin that hangs
or crashes cannot take the executor with it.
"""

from concurrent.futures import Executor, ThreadPoolExecutor

import attrs

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.files.errors import InputError


@attrs.frozen(kw_only=True)
class Serial(ExecutorSource):
    """One run after another: for timing."""

    def open(self, workers: int) -> Executor:
        """Use one thread."""
        if workers != 1:
            raise InputError(f"the executor serial has one worker, not {workers}", hint="processes has several")
        return ThreadPoolExecutor(1, "mrpbench-run")


@attrs.frozen(kw_only=True)
class Processes(ExecutorSource):
    """`--workers` runs at once, each in a process of its own."""

    def open(self, workers: int) -> Executor:
        """Use one thread per worker."""
        return ThreadPoolExecutor(workers, "mrpbench-run")
