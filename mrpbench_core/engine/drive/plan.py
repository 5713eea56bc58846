"""Calls a planner and measures the call."""

import math
import os
import resource
from contextlib import suppress
from time import perf_counter, process_time  # by name: a plugin that replaces `time.perf_counter` changes no record
from typing import Any

import attrs

from mrpbench_core.api.planner import Planner, PlannerSession
from mrpbench_core.checking.plan_result import result_fault
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.engine.stage import RunEnded
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.plan import Budget, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.runs.status import RunStatus, Stage

LATE_S = 0.1
"""Wall seconds after the limit within which a planner that ended its search at the limit may still return."""


def call_planner(
    planner: Planner, problem: Problem, budget: Budget, session: PlannerSession | None = None
) -> tuple[PlanResult, dict[str, Any]]:
    """The result of the planner, valid or not, and the timing of the call alone; without a `session` it begins one.

    The time of `Planner.skip` counts, because a planner could plan there. CPU time counts programs that the planner ran
    to their end; peak memory is that of this process alone. A plan that comes more than `LATE_S` after the limit is
    dropped: the planner timed out.

    Raises:
        RunEnded: the planner skips the problem.
    """
    _reset_peak()
    before = _resident()
    began, cpu = perf_counter(), cpu_s()
    if reason := planner.skip(problem):
        raise RunEnded(RunStatus.SKIPPED, Stage.PLANNING, str(reason))
    try:
        result = (session or planner.start()).plan(problem, budget)
    except InputError as error:  # no mistake of the user's any more: the problem was sound
        raise RuntimeError(f"the planner raised InputError: {error}") from error
    seconds = perf_counter() - began
    timing: dict[str, Any] = {
        "planning_s": seconds,
        "planning_cpu_s": cpu_s() - cpu,
        "planning_peak_bytes": max(0, _peak() - before),
    }
    sound = result_fault(result) is None
    late = seconds > budget.wall_s + LATE_S
    if sound and late and result.status in (PlanStatus.SOLVED, PlanStatus.TIMEOUT):
        result = attrs.evolve(result, status=PlanStatus.TIMEOUT, plan=None)
    timing["clock_bound"] = sound and (bool(result.clock_bound) or result.status == PlanStatus.TIMEOUT)
    if sound and result.history:
        timing["planning_history"] = _history(result)
    return result, timing


def _history(result: PlanResult) -> list[list[float | None]]:
    """The anytime curve as rows [seconds, cost, lower bound]; null for what is not known."""
    return [[value if math.isfinite(value) else None for value in attrs.astuple(point)] for point in result.history]


def budget_of(config: RunConfig) -> Budget:
    """The budget of one call of a planner.

    The memory is less than the run's, so that the planner stops by itself before the run is killed. The seed comes from
    a stream of its own, keyed by the run's seed and repeat.
    """
    limits = config.limits
    return Budget(
        wall_s=limits.planning,
        memory_bytes=max(1, int(0.9 * limits.memory) - _resident()),
        iterations=limits.iterations,
        seed=Seeds(config.seed, config.repeat).seed_of("planner") >> 32,  # 31 bits, which any program reads
    )


def cpu_s() -> float:
    """CPU seconds of this process and of the programs that it has run."""
    programs = resource.getrusage(resource.RUSAGE_CHILDREN)
    return process_time() + programs.ru_utime + programs.ru_stime


def _reset_peak() -> None:
    with suppress(OSError):  # else the peak is that of the whole process so far: an upper bound
        descriptor = os.open("/proc/self/clear_refs", os.O_WRONLY | os.O_CLOEXEC)
        try:
            os.write(descriptor, b"5")
        finally:
            os.close(descriptor)


def _status_bytes(key: bytes) -> int | None:
    """An entry of `/proc/self/status`, several times in each call: `Path` takes three times as long."""
    with suppress(OSError, IndexError):
        descriptor = os.open("/proc/self/status", os.O_RDONLY | os.O_CLOEXEC)
        try:
            return int(os.read(descriptor, 1 << 13).partition(key)[2].split(maxsplit=1)[0]) * 1024
        finally:
            os.close(descriptor)
    return None


def _resident() -> int:
    return _status_bytes(b"\nVmRSS:") or 0


def _peak() -> int:
    return _status_bytes(b"\nVmHWM:") or resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
