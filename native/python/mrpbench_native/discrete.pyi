"""Discrete executions by the rules of the League of Robot Runners, in C++.

Arrays are new. Times are steps (2023, 2024) or ticks (2026).
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

class Execution:
    """Robots, tasks, a scheduler and a planner; for 2026 also an executor and delays."""

    def run_until(self, time: int) -> None:
        """Advance to the end of a step or tick; other threads may run meanwhile."""
    @property
    def time(self) -> int:
        """Now."""
    @property
    def finished(self) -> int:
        """Tasks."""
    @property
    def errands(self) -> int:
        """Errands that are done."""
    @property
    def pose(self) -> NDArray[np.int32]:
        """i4[n,3]: row, column, heading."""
    @property
    def letters(self) -> NDArray[np.uint8]:
        """u1[T,n]: ASCII letters of actions, see `mrpbench_league.files.motion`."""
    @property
    def unexecuted(self) -> NDArray[np.int32]:
        """i4[k,3]: row of `letters`, robot, and letter of each action that was asked for and did not happen, because of
        a delay, a fault or another robot; `T`: no answer came in time.
        """
    @property
    def events(self) -> NDArray[np.int32]:
        """i4[k,4]: time, robot, task, errands done; 0 errands: given to the robot (2023)."""
    @property
    def tasks(self) -> NDArray[np.int32]:
        """i4[m,4]: line of the task file, time of reveal, errands done, robot that opened it (-1 = none)."""
    @property
    def delays(self) -> NDArray[np.int32]:
        """i4[k,3]: robot, and the ticks [start, end) of its delays."""
    @property
    def segments(self) -> NDArray[np.int32]:
        """i4[s,n,4]: row, column, heading and counter at every hundredth tick of `letters` (2026)."""
    @property
    def schedule(self) -> list[tuple[tuple[int, int], ...]]:
        """For each robot: time and task, -1 = none."""
    @property
    def errors(self) -> list[tuple[int, int, int, str]]:
        """Robot, other robot, time, text of each invalid action."""
    @property
    def schedule_errors(self) -> list[tuple[int, int, int, int, str]]:
        """Task, robot, other robot, time, text of each invalid assignment."""
    @property
    def call_seconds(self) -> NDArray[np.float64]:
        """Seconds of each call of scheduler and planner."""
    @property
    def late_calls(self) -> int:
        """Calls that took longer than the limit."""
    @property
    def preprocessing_seconds(self) -> float:
        """Wall seconds before the first call."""
    @property
    def refused(self) -> int:
        """Motions that the rules refused because a robot was in the way (2026)."""

def open(  # noqa: A001 - as `io.open`
    *,
    problem: Any,
    planner: str,
    depth: int,
    improve: bool,
    threads: int,
    guidance: bool,
    active: int | None,
    limit: float,
    iterations: int | None,
    seed: int,
    preprocessing: float,
    table_mib: int,
    period: int,
) -> Execution:
    """Begin an execution; for 2026 this makes the first plan.

    Args:
        problem: a `mrpbench_league.files.problem.LorrProblem`.
        planner: `pibt` or `epibt`.
        depth: actions of an operation of `epibt`: 3, 4 or 5.
        improve: large neighbourhood search of `epibt`.
        threads: of this search; results do not depend on their number if `iterations` is given.
        guidance: whether moves cost more where there is traffic.
        active: robots that have a goal at the same time, at most; None: half as many as there are free cells.
        limit: seconds of one answer.
        iterations: rounds of improvement in each step that is planned; the clock is then not read.
        seed: of the planner.
        preprocessing: seconds before the first step in which distance tables are computed; none if `iterations` is
            given.
        table_mib: memory for distance tables, in MiB; values do not depend on it.
        period: ticks between two calls of the planner (2026).

    Raises:
        ValueError: an argument is out of range, or a cell of the problem is not free.
    """
