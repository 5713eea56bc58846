"""The worker slots of this process, shared by the threads of an executor or of a remote worker."""

import threading
from typing import Any

from mrpbench_core.engine.processes.job import Job, JobOutcome
from mrpbench_core.engine.processes.slot import Slot, SlotStopped

_LOCK = threading.Lock()
_POOLS: dict[str, "Slots"] = {}


class Slots:
    """As many slots as runs are executed at once; an idle slot executes the next run."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._idle: list[Slot] = []
        self._busy: set[Slot] = set()
        self._closed = False

    def run(self, job: Job) -> JobOutcome:
        """Execute a run in an idle slot, or in a new one.

        Raises:
            SlotStopped: the slots were closed.
        """
        with self._lock:
            if self._closed:
                raise SlotStopped
            slot = self._idle.pop() if self._idle else Slot()
            self._busy.add(slot)
        try:
            return slot.run(job)
        finally:
            with self._lock:
                self._busy.discard(slot)
                if not self._closed:
                    self._idle.append(slot)

    def progress(self) -> list[dict[str, Any]]:
        """How far each run is that is being executed; see `Slot.progress`."""
        with self._lock:
            return [found for slot in self._busy if (found := slot.progress) is not None]

    def close(self) -> None:
        """End every child, and with them the runs in flight."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, []
            for slot in self._busy:
                slot.stop()
        for slot in idle:
            slot.close()


def run_in_slot(invocation: str, job: Job) -> JobOutcome:
    """Execute a run in one of this process's slots for an invocation; executors call this function."""
    with _LOCK:
        slots = _POOLS.setdefault(invocation, Slots())
    return slots.run(job)


def progress_in_slots(invocation: str) -> list[dict[str, Any]]:
    """How far each run of an invocation is that is executed in this process; see `Slot.progress`."""
    with _LOCK:
        slots = _POOLS.get(invocation)
    return [] if slots is None else slots.progress()


def close_slots(invocation: str) -> None:
    """End the children that serve an invocation in this process."""
    with _LOCK:
        slots = _POOLS.pop(invocation, None)
    if slots is not None:
        slots.close()
