"""LastExecutor: leave processors to others."""

import os
from concurrent.futures import Executor, ThreadPoolExecutor

import attrs
from mrpbench_core.api import ExecutorSource, option


@attrs.frozen(kw_only=True)
class LastExecutor(ExecutorSource):
    """Does as many runs at a time as `--workers` says, but leaves some processors of this machine idle.

    Each call waits in a thread for a process of its own, so threads are enough.
    """

    spare: int = option(1, help="processors that stay idle if there are several", validator=attrs.validators.ge(0))

    def open(self, workers: int) -> Executor:
        """Return a pool of threads."""
        usable = len(os.sched_getaffinity(0)) - self.spare
        return ThreadPoolExecutor(max(1, min(workers, usable)), "last_executor")
