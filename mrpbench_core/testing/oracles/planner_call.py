"""Asks a planner and stops waiting when it does not answer."""

import threading
import time

from mrpbench_core.api.planner import Planner
from mrpbench_core.model.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.problem import Problem
from mrpbench_core.testing.faults import Fault, require

AMPLE = 10.0
"""seconds for problems that a pen solves."""
MARGIN = 2.0
"""seconds by which a planner may be late: machines are busy, and Python sleeps."""
ITERATIONS = 200
"""steps of improvement of a planner that would go on until its time is over."""
PATIENCE = 10.0
"""seconds after which it is said to hang."""


def ask(planner: Planner, problem: Problem, wall_s: float = AMPLE) -> PlanResult:
    """The planner's answer, which is one and in time.

    Raises:
        Fault: it is not.
    """
    answers: list[PlanResult] = []
    failures: list[BaseException] = []

    def call() -> None:
        try:
            answers.append(planner.plan(problem, Budget(wall_s=wall_s, memory_bytes=1 << 30, iterations=ITERATIONS)))
        except BaseException as error:  # noqa: BLE001 - raised again in the caller's thread
            failures.append(error)

    begun = time.monotonic()
    thread = threading.Thread(target=call, daemon=True)  # a daemon, so that one that hangs does not keep us
    thread.start()
    thread.join(wall_s + MARGIN + PATIENCE)
    took = time.monotonic() - begun
    if failures:
        raise failures[0]
    require(answers, f"still runs {took:.0f} s after it was given {wall_s:g} s")
    require(took <= wall_s + MARGIN, f"took {took:.1f} s when it was given {wall_s:g} s")
    result = answers[0]
    require(isinstance(result, PlanResult), f"returns {type(result).__name__} instead of PlanResult")
    if (result.plan is not None) != (result.status is PlanStatus.SOLVED) and result.status is not PlanStatus.TIMEOUT:
        raise Fault(f"says {result.status} {'with' if result.plan else 'without'} a plan")
    return result
