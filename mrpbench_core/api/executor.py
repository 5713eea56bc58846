"""Contract of the kind *executor* (provisional)."""

from abc import abstractmethod
from collections.abc import Callable
from concurrent.futures import Executor
from typing import Any, ClassVar

from mrpbench_core.api.component import Component


class WorkerLost(Exception):  # noqa: N818 - not an error of the call
    """The worker of a call was lost: the engine repeats the run as the next attempt and reports it."""


class RemoteExecutor(Executor):
    """An executor whose calls run in other processes, which may outlive it.

    It must not repeat a call by itself; a call raises `WorkerLost` if its worker was lost.
    """

    @abstractmethod
    def everywhere(self, function: Callable[..., object], *arguments: Any) -> None:
        """Call `function` once in each process that may have executed calls; skip processes that are gone."""


class ExecutorSource(Component):
    """Executes runs."""

    group: ClassVar[str] = "mrpbench.executors"

    @abstractmethod
    def open(self, workers: int) -> Executor:
        """Return an executor that runs up to `workers` calls at a time, and is shut down in the end.

        The result of each call must be the one that the call returned: what is said of another run, or has another
        form, ends the study with an error that names the executor.
        """
