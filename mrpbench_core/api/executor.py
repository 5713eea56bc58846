"""Contract of the kind *executor* (provisional)."""

from abc import abstractmethod
from concurrent.futures import Executor
from typing import ClassVar

from mrpbench_core.api.component import Component


class ExecutorSource(Component):
    """Where runs execute."""

    group: ClassVar[str] = "mrpbench.executors"

    @abstractmethod
    def open(self, workers: int) -> Executor:
        """Return an executor that runs up to `workers` calls at once; it is used as a context manager."""
