"""The executor `dask`: runs on the workers of a Dask cluster.

Dask silently repeats a task whose worker was lost, even if only its result was not fetched yet. A repeated run must be
a new attempt. Each call therefore sets an event at the scheduler when it begins; a call whose event is already set only
reports that the first one was lost.
"""

import itertools
import uuid
from collections.abc import Callable
from concurrent.futures import Executor, Future
from concurrent.futures import wait as wait_for
from typing import Any, TypeVar

import attrs
from distributed import CancelledError, Client, Event
from distributed import Future as Remote
from distributed.scheduler import KilledWorker

from mrpbench_core.api import ExecutorSource, option
from mrpbench_core.api.executor import RemoteExecutor, WorkerLost
from mrpbench_core.files.errors import InputError

T = TypeVar("T")
LOST = "the Dask worker that executed it was lost"


@attrs.frozen(kw_only=True)
class Dask(ExecutorSource):
    """Executes runs on the workers of a Dask cluster, which share the results folder and have the same plugins."""

    scheduler: str = option(help="address of the scheduler, e.g. tcp://10.0.0.1:8786")
    timeout: float = option(10.0, help="time to wait for the scheduler", unit="s", validator=attrs.validators.gt(0))

    def open(self, workers: int) -> Executor:  # noqa: ARG002 - the engine hands out no more calls than this
        """Connect to the scheduler."""
        try:
            client = Client(self.scheduler, timeout=self.timeout, set_as_default=False)
        except (OSError, ValueError, TypeError, RuntimeError) as error:  # the last two of TLS
            reason = " ".join(str(error).split())
            raise InputError(f"executor.scheduler: no Dask scheduler answers at {self.scheduler}: {reason}") from None
        return Cluster(client)


class Cluster(RemoteExecutor):
    """Calls on the workers of one cluster."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._name = f"mrpbench-{uuid.uuid4().hex}"
        self._number = itertools.count()
        self._going: set[Future[Any]] = set()

    def submit(self, function: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """Call once on some worker; raises `WorkerLost` there if that worker was lost."""
        key = f"{self._name}-{next(self._number)}"
        ours: Future[T] = Future()
        self._going.add(ours)
        remote = self._client.submit(once, key, function, args, kwargs, key=key, pure=False, retries=0)

        def hand_on(remote: Remote) -> None:
            self._going.discard(ours)
            if not ours.set_running_or_notify_cancel():
                return
            try:
                ours.set_result(remote.result())
            except KilledWorker:
                ours.set_exception(WorkerLost(LOST))
            except CancelledError:
                ours.set_exception(InputError("the Dask scheduler was lost", hint="the same command continues"))
            except BaseException as error:  # noqa: BLE001 - whatever the call raised
                ours.set_exception(error)

        def take_back(ours: Future[T]) -> None:
            self._going.discard(ours)
            if ours.cancelled():
                remote.cancel()

        ours.add_done_callback(take_back)
        remote.add_done_callback(hand_on)
        return ours

    def everywhere(self, function: Callable[..., object], *arguments: Any) -> None:
        """Call once on each worker that is left."""
        if self._client.status == "running":
            self._client.run(function, *arguments, on_error="ignore")

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Disconnect; the cluster continues."""
        going = list(self._going)
        if cancel_futures:
            for future in going:
                future.cancel()
        if wait:
            wait_for(going)
        self._client.close()


def once(key: str, function: Callable[..., T], args: tuple[Any, ...], kwargs: dict[str, Any]) -> T:
    """Make the call unless it has begun before; a worker executes this.

    Raises:
        WorkerLost: it was.
    """
    begun = Event(f"{key}-begun")
    if begun.is_set():
        raise WorkerLost(LOST)
    begun.set()
    return function(*args, **kwargs)
