"""Contract of the kind *executor* (provisional)."""

from abc import abstractmethod
from collections.abc import Callable
from concurrent.futures import Executor
from typing import Any, ClassVar

from mrpbench_core.api.component import Component


class WorkerLost(Exception):  # noqa: N818 - not an error of the call
    """What a call raises whose worker was lost: the engine does the run again, as its next attempt, and says so."""


class RemoteExecutor(Executor):
    """An executor whose calls run in other processes, which may outlive it.

    It must not repeat a call on its own: a call whose worker was lost raises `WorkerLost`.
    """

    @abstractmethod
    def everywhere(self, function: Callable[..., object], *arguments: Any) -> None:
        """Call `function` once in each process that may have executed calls; those that are gone are passed over."""


class ExecutorSource(Component):
    """Where runs execute."""

    group: ClassVar[str] = "mrpbench.executors"

    @abstractmethod
    def open(self, workers: int) -> Executor:
        """Return an executor that runs up to `workers` calls at once; it is used as a context manager."""
