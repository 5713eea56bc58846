"""Commitments of a new plan: the released part of the old plan, with the times that it really takes."""

import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.plan import Path, Plan
from mrpbench_core.model.planning.problem import Problem


def commitments(
    problem: Problem, plan: Plan, released: Int32, reached: Int32, ready: Int, due: int
) -> tuple[Path, ...]:
    """The released prefix of each path, with updated times.

    What was reached keeps its times, so that the order in which robots passed is kept too. The segment under way ends
    when its robot is `ready`, what was released beyond it follows at once, and a robot that then has time waits until
    `due`. Segments keep their indices: only a wait is appended. Times never become earlier than they were, and a
    dispatcher that keeps a plan's order (`adg`) has released nothing that another robot must pass before, so the
    prefixes of a plan without conflicts have none.

    Args:
        problem: that `plan` solves; gives the durations.
        plan: in force.
        released: i4[n] leading segments of each path that its robot may complete.
        reached: i4[n] leading segments that it has completed.
        ready: i8[n] ticks at which each robot comes to the end of the first segment not reached.
        due: tick at which the new plan takes effect.
    """
    return tuple(
        _retimed(path, problem.duration(robot), int(released[robot]), int(reached[robot]), int(ready[robot]), due)
        for robot, path in enumerate(plan.paths)
    )


def _retimed(path: Path, duration: Int32, released: int, reached: int, ready: int, due: int) -> Path:
    edge, leave = path.edge[:released].tolist(), path.leave[:released].tolist()
    enter = path.enter[:1].tolist() if released else []
    for segment in range(released):
        if segment:
            enter.append(leave[segment - 1])
        if segment >= reached:
            least = int(duration[edge[segment]]) if edge[segment] >= 0 else 0
            soonest = ready if segment == reached else 0
            leave[segment] = max(leave[segment], soonest, enter[segment] + least)
    end = leave[-1] if released else 0
    if end < due:
        edge.append(-1)
        enter.append(end)
        leave.append(due)
    return Path(edge=np.array(edge, np.int32), enter=np.array(enter, np.int64), leave=np.array(leave, np.int64))
