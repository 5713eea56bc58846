"""The old plan at a new one: its released part, with the times that it really takes, and the rest of it."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.planning.plan import Paths, Plan, waits
from mrpbench_core.model.planning.problem import Problem, ends_of


def commitments(problem: Problem, plan: Plan, released: Int32, reached: Int32, ready: Int, due: int) -> Paths:
    """The released prefix of each path, with updated times.

    What was reached keeps its times, so that the order in which robots passed is kept too. The segment under way ends
    when its robot is `ready`, what was released beyond it follows at once, and a robot that then has time waits until
    `due`. Segments keep their indices: only a wait is appended. Times never become earlier than they were, and a
    dispatcher that keeps a plan's order (`adg`) has released nothing that another robot must pass before, so the
    prefixes of a plan without conflicts have none.

    Args:
        problem: that `plan` solves; gives the durations.
        plan: the current one.
        released: i4[n] leading segments of each path that its robot may complete.
        reached: i4[n] leading segments that it has completed.
        ready: i8[n] ticks at which each robot comes to the end of the first segment not reached.
        due: tick at which the new plan takes effect.
    """
    released_paths = Paths.of(plan.paths).part(np.zeros_like(released), released)
    leave = released_paths.leave.copy()
    least, moves = np.zeros_like(leave), released_paths.edge >= 0
    least[moves] = problem.roadmap.duration[problem.profile[released_paths.robot[moves]], released_paths.edge[moves]]
    for later in range(int((released - reached).max(initial=0))):
        robots = np.flatnonzero(reached + later < released)
        row = released_paths.first[robots] + reached[robots] + later
        enter = np.where(row > released_paths.first[robots], leave[row - 1], released_paths.enter[row])
        soonest = ready[robots] if later == 0 else 0
        leave[row] = np.maximum(np.maximum(leave[row], soonest), enter + least[row])
    follows = np.flatnonzero(released_paths.segment)
    enter = released_paths.enter.copy()
    enter[follows] = leave[follows - 1]
    ends = np.where(released_paths.size > 0, np.append(leave, 0)[released_paths.first[1:] - 1], problem.begins)
    return attrs.evolve(released_paths, enter=enter, leave=leave).then(waits(ends, due))


def not_ahead(problem: Problem, plan: Plan, reached: Int32, now: int) -> tuple[Problem, Plan]:
    """Return both with earlier times, such that no segment that was `reached` i4[n] ends after tick `now`.

    Robots that a dispatcher releases by their order are ahead of a plan's times where these are too late, as where all
    robots come to rest first. One shift of all times keeps every order; paths may begin before tick 0 then.
    """
    paths = Paths.of(plan.paths)
    last = np.flatnonzero(reached)
    ahead = int((paths.leave[paths.first[last] + reached[last] - 1] - now).max(initial=0))
    if not ahead:
        return problem, plan
    changed = attrs.evolve(problem, since=problem.begins - ahead, ready=problem.ready - ahead)
    return changed, attrs.evolve(plan, paths=paths.later(-ahead))


def remaining(plan: Plan, released: Int32, problem: Problem) -> Paths:
    """What follows the `released` i4[n] segments in `plan`, all of it as much later as the commitments of `problem`.

    One shift for all robots keeps every order among them, and that to the commitments, none of which is delayed more.
    """
    whole = Paths.of(plan.paths)
    rest = whole.part(released, whole.size)
    before, now = whole.part(np.zeros_like(released), released), Paths.of(problem.commitments)
    some = np.flatnonzero(rest.size)
    begin = np.array(ends_of(problem), np.int64)
    later = int((now.part(np.zeros_like(released), released).leave - before.leave).max(initial=0))
    later = max(later, int((np.maximum(begin, problem.ready)[some] - rest.enter[rest.first[some]]).max(initial=0)))
    enter = begin.copy()
    enter[some] = rest.enter[rest.first[some]] + later
    return waits(begin, enter).then(rest.later(later))
