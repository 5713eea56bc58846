"""Executors on this machine: `serial` and `processes`.

Both hand out threads. What a thread is given to call drives one supervised worker process, so that a plugin that hangs
or crashes cannot take the executor with it.
"""

from concurrent.futures import Executor, ThreadPoolExecutor

import attrs

from mrpbench_core.api.executor import ExecutorSource


@attrs.frozen(kw_only=True)
class Serial(ExecutorSource):
    """One run after another, whatever `--workers` says: for timing."""

    def open(self, workers: int) -> Executor:  # noqa: ARG002
        """One thread."""
        return ThreadPoolExecutor(1, "mrpbench-run")


@attrs.frozen(kw_only=True)
class Processes(ExecutorSource):
    """`--workers` runs at once, each in a process of its own."""

    def open(self, workers: int) -> Executor:
        """As many threads as workers."""
        return ThreadPoolExecutor(workers, "mrpbench-run")
