"""Calls a planner, and stops waiting when it does not answer."""

import threading
import time

from mrpbench_core.api.planner import Planner
from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.faults import require

AMPLE_S = 10.0
"""Wall seconds for the small problems of the kit."""
LATE_S = 2.0
"""Seconds by which a planner may exceed its budget: machines are busy, and Python sleeps."""
ITERATIONS = 200
"""Iterations of a planner that improves its plan until its time is over."""
HANGS_S = 10.0
"""Further seconds after which the planner is said to hang."""


def call(planner: Planner, problem: Problem, wall_s: float = AMPLE_S) -> PlanResult:
    """The planner's answer, well-formed and in time.

    Raises:
        Fault: the answer is late or malformed.
    """
    answers: list[PlanResult] = []
    errors: list[BaseException] = []

    def target() -> None:
        try:
            answers.append(planner.plan(problem, Budget(wall_s=wall_s, memory_bytes=1 << 30, iterations=ITERATIONS)))
        except BaseException as error:  # noqa: BLE001 - raised again in the caller's thread
            errors.append(error)

    begun = time.monotonic()
    thread = threading.Thread(target=target, daemon=True)  # a planner that hangs must not keep the process alive
    thread.start()
    thread.join(wall_s + LATE_S + HANGS_S)
    took = time.monotonic() - begun
    if errors:
        raise errors[0]
    require(answers, f"still runs {took:.0f} s after it was given {wall_s:g} s: check `budget.wall_s` in every loop")
    require(took <= wall_s + LATE_S, f"took {took:.1f} s when it was given {wall_s:g} s: check `budget.wall_s`")
    result = answers[0]
    fault = result_fault(result)
    require(fault is None, str(fault))
    solved_without_plan = result.status is PlanStatus.SOLVED and result.plan is None
    require(not solved_without_plan, "returned the status solved without a plan")
    return result
