"""A worker slot: one long-lived child process that executes one run after another.

Whatever a plugin does, a run ends with an outcome: the slot ends a child that passes a limit, and replaces one that
died.
"""

import signal
import threading
from typing import Any

import attrs

from mrpbench_core.engine.processes.child import SAMPLING_S, Child, WorkerDied
from mrpbench_core.engine.processes.job import Job, JobOutcome
from mrpbench_core.engine.processes.limits import LimitMonitor
from mrpbench_core.engine.processes.machine import oom_kills
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.model.runs.status import RunStatus, Stage

START_S = 120.0
"""Seconds a child may take to import the core."""
SPARE = 4
"""A child that keeps more than this fraction (1 / SPARE) of the memory limit after a run is replaced."""


OUTSIDE = frozenset({signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP})
"""Signals that people and batch systems send, and that defects do not raise."""


class SlotStopped(Exception):  # noqa: N818 - not an error
    """The slot was stopped while it executed a run."""


class Slot:
    """Executes runs one at a time; `stop` may be called from another thread."""

    def __init__(self) -> None:
        self.progress: dict[str, Any] | None = None
        """How far the current run is in its execution, with its `run_id`; None outside of executions."""
        self._child: Child | None = None
        self._machine: dict[str, Any] | None = None
        self._stopped = False
        self._lock = threading.Lock()

    def run(self, job: Job) -> JobOutcome:
        """Execute a run.

        Raises:
            SlotStopped: the slot was stopped.
        """
        monitor = LimitMonitor(job)
        oom_before = oom_kills()
        try:
            child = self._ready(job)
            monitor = LimitMonitor(job)  # a child's start is no part of the run
            outcome = self._follow(child, job, monitor)
            if self._child is not None and not child.is_tidy(job.memory_bytes // SPARE):
                self._discard()
            return attrs.evolve(outcome, machine=self._machine)
        except WorkerDied as death:
            self._discard()
            if death.signal == signal.SIGKILL and oom_kills() > oom_before:
                failure = monitor.failure(
                    RunStatus.OUT_OF_MEMORY, "the machine ran out of memory, and the kernel ended the run"
                )
                return JobOutcome(run_id=job.run_id, failure=failure)
            failure = monitor.failure(RunStatus.CRASHED, str(death))
            return JobOutcome(run_id=job.run_id, failure=failure, lost=death.signal in OUTSIDE)
        except OSError as error:
            return JobOutcome(run_id=job.run_id, mistake=f"no worker can be started: {error}")
        finally:
            self.progress = None
            if self._stopped:
                self._discard()
                raise SlotStopped

    def stop(self) -> None:
        """End the child, and with it the run it executes."""
        with self._lock:
            self._stopped = True
            if self._child is not None:
                self._child.kill()

    def close(self) -> None:
        """End an idle child."""
        self._discard()

    def _follow(self, child: Child, job: Job, monitor: LimitMonitor) -> JobOutcome:
        child.send(job.message())
        while True:
            message = child.receive(min(SAMPLING_S, monitor.patience()))
            if message is None:
                memory = child.memory()
                failure = monitor.overrun() or (None if memory is None else monitor.overweight(memory))
                if failure is not None:
                    self._discard()
                    return JobOutcome(run_id=job.run_id, failure=failure)
            elif "progress" in message:
                self.progress = {"run_id": job.run_id, **message["progress"]}
            elif "stage" in message:
                self.progress = None
                monitor.enter(Stage(message["stage"]), message.get("limit_s"), message.get("scenario_id"))
            elif "record" in message:
                return JobOutcome(run_id=job.run_id, record=RunRecord.of_message(message["record"]))
            elif "mistake" in message:
                return JobOutcome(run_id=job.run_id, mistake=message["mistake"])
            else:
                return JobOutcome(
                    run_id=job.run_id, failure=monitor.failure(RunStatus(message["status"]), message["message"])
                )

    def _ready(self, job: Job) -> Child:
        """An idle child: the one at hand, or a new one."""
        if self._child is not None and not self._child.is_alive():
            self._discard()
        if self._child is None:
            with self._lock:
                if self._stopped:
                    raise SlotStopped
                self._child = Child(job.log)
            greeting = self._child.receive(START_S)
            if greeting is None:
                raise WorkerDied(f"the worker process did not start within {START_S:g} s")
            self._machine = greeting["machine"]
        return self._child

    def _discard(self) -> None:
        with self._lock:
            child, self._child = self._child, None
        if child is not None:
            child.close()
