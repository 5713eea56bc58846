"""Commitments of a new plan: the released part of the old plan, with the times that it really takes."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.plan import Paths, Plan, waits
from mrpbench_core.model.planning.problem import Problem


def commitments(problem: Problem, plan: Plan, released: Int32, reached: Int32, ready: Int, due: int) -> Paths:
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
    kept = Paths.of(plan.paths).part(np.zeros_like(released), released)
    leave = kept.leave.copy()
    least, moves = np.zeros_like(leave), kept.edge >= 0
    least[moves] = problem.roadmap.duration[problem.profile[kept.robot[moves]], kept.edge[moves]]
    for later in range(int((released - reached).max(initial=0))):
        robots = np.flatnonzero(reached + later < released)
        row = kept.first[robots] + reached[robots] + later
        enter = np.where(row > kept.first[robots], leave[row - 1], kept.enter[row])
        soonest = ready[robots] if later == 0 else 0
        leave[row] = np.maximum(np.maximum(leave[row], soonest), enter + least[row])
    follows = np.flatnonzero(kept.segment)
    enter = kept.enter.copy()
    enter[follows] = leave[follows - 1]
    ends = np.where(kept.size > 0, np.append(leave, 0)[kept.first[1:] - 1], 0)
    return attrs.evolve(kept, enter=enter, leave=leave).then(waits(ends, due))
