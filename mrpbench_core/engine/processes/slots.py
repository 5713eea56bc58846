"""The worker slots of this process, shared by the threads of an executor or of a remote worker."""

import secrets
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

from mrpbench_core.engine.processes.job import Job, JobOutcome
from mrpbench_core.engine.processes.slot import Slot, SlotStopped
from mrpbench_core.files.platforms import require_linux

T = TypeVar("T")
_LOCK = threading.Lock()
_POOLS: dict[str, "Slots"] = {}
_OPEN: ContextVar[str | None] = ContextVar("slots of this process", default=None)


class Slots:
    """As many slots as runs are executed at once; an idle slot executes the next run."""

    def __init__(self) -> None:
        require_linux()
        self._lock = threading.Lock()
        self._idle: list[Slot] = []
        self._busy: set[Slot] = set()
        self._closed = False

    def use(self, work: Callable[[Slot], T]) -> T:
        """Call `work` with an idle slot, or with a new one.

        Raises:
            SlotStopped: the slots were closed.
        """
        with self._lock:
            if self._closed:
                raise SlotStopped
            slot = self._idle.pop() if self._idle else Slot()
            self._busy.add(slot)
        try:
            return work(slot)
        finally:
            with self._lock:
                self._busy.discard(slot)
                if not self._closed:
                    self._idle.append(slot)

    def progress(self) -> list[dict[str, Any]]:
        """How far each run is that is being executed; see `Slot.progress`."""
        with self._lock:
            return [report for slot in self._busy if (report := slot.progress) is not None]

    def close(self) -> None:
        """End every child, and with them the runs in flight."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, []
            for slot in self._busy:
                slot.stop()
        for slot in idle:
            slot.close()


@contextmanager
def slots_of_this_process() -> Iterator[str]:
    """A key for worker slots in this process, which end with the outermost of nested contexts: workers start once."""
    if (outer := _OPEN.get()) is not None:
        yield outer
        return
    key = secrets.token_hex(8)
    token = _OPEN.set(key)
    try:
        yield key
    finally:
        _OPEN.reset(token)
        close_slots(key)


def run_in_slot(key: str, job: Job) -> JobOutcome:
    """Execute a run in one of this process's slots for an invocation; executors call this function."""
    with _LOCK:
        slots = _POOLS.setdefault(key, Slots())
    return slots.use(lambda slot: slot.run(job))


def ask_in_slot(key: str, job: Mapping[str, Any]) -> dict[str, Any]:
    """Let one of this process's slots execute a job; see `Slot.ask`."""
    with _LOCK:
        slots = _POOLS.setdefault(key, Slots())
    return slots.use(lambda slot: slot.ask(job))


def progress_in_slots(key: str) -> list[dict[str, Any]]:
    """How far each run of an invocation is that is executed in this process; see `Slot.progress`."""
    with _LOCK:
        slots = _POOLS.get(key)
    return [] if slots is None else slots.progress()


def close_slots(key: str) -> None:
    """End the children that serve an invocation in this process."""
    with _LOCK:
        slots = _POOLS.pop(key, None)
    if slots is not None:
        slots.close()
