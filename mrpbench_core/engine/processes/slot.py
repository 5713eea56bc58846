"""A worker slot: one supervisor process that executes one run after another.

Whatever a plugin does, a run ends with an outcome, and a supervisor that ended is replaced.
"""

import threading
import time
from collections.abc import Mapping
from typing import Any

from mrpbench_core.engine.processes.child import OUTSIDE, Child, WorkerDied
from mrpbench_core.engine.processes.job import Failure, Job, JobOutcome
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.model.runs.status import RunStatus, Stage

START_S = 120.0
"""Seconds a supervisor may take to import the core."""
LATE_S = 60.0
"""Seconds after the wall limit of a job when its supervisor, which ends a job at its limit, cannot be working."""


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
        try:
            answer = self.ask(job.message())
        except WorkerDied as death:
            failure = Failure(
                status=RunStatus.CRASHED,
                stage=Stage.WORKER,
                message=str(death),
                seconds=0.0,
                lost=death.signal in OUTSIDE,
            )
            return JobOutcome(run_id=job.run_id, failure=failure)
        except OSError as error:
            return JobOutcome(run_id=job.run_id, mistake=f"no worker can be started: {error}")
        return JobOutcome(
            run_id=job.run_id,
            record=RunRecord.of_message(answer["record"]) if "record" in answer else None,
            failure=Failure.of_message(answer["failure"]) if "failure" in answer else None,
            mistake=answer.get("mistake"),
            machine=self._machine,
        )

    def ask(self, job: Mapping[str, Any]) -> dict[str, Any]:
        """Let the supervisor execute a job; return its answer.

        Raises:
            SlotStopped: the slot was stopped.
            WorkerDied: the supervisor ended.
            OSError: no process can be started.
        """
        try:
            child = self._ready()
            child.send(job)
            deadline = time.monotonic() + job["wall_s"] + LATE_S
            while True:
                message = child.receive(max(0.0, deadline - time.monotonic()))
                if message is None:
                    raise WorkerDied("the supervisor process did not end the run at its wall limit")
                if "progress" not in message:
                    return message
                facts = message["progress"]
                self.progress = None if facts is None else {"run_id": job["run_id"], **facts}
        except WorkerDied:
            self._discard()
            raise
        finally:
            self.progress = None
            if self._stopped:
                self._discard()
                raise SlotStopped

    def stop(self) -> None:
        """End the supervisor, and with it the run it executes."""
        with self._lock:
            self._stopped = True
            if self._child is not None:
                self._child.stop()

    def close(self) -> None:
        """End an idle supervisor."""
        self._discard()

    def _ready(self) -> Child:
        """An idle supervisor: the one at hand, or a new one."""
        if self._child is not None and not self._child.is_alive():
            self._discard()
        if self._child is None:
            with self._lock:
                if self._stopped:
                    raise SlotStopped
                self._child = Child()
            greeting = self._child.receive(START_S)
            if greeting is None:
                raise WorkerDied(f"the supervisor process did not start within {START_S:g} s")
            self._machine = greeting["machine"]
        return self._child

    def _discard(self) -> None:
        with self._lock:
            child, self._child = self._child, None
        if child is not None:
            child.close()
