"""Planners that move all robots tick by tick."""

import numpy as np

from mrpbench_core.model.planning.problem import Problem
from mrpbench_planners_mapf.recipe import NativePlanner


class UnitMoves(NativePlanner):
    """A planner for problems in which every move takes one tick and robots stay at their goals."""

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also robots that disappear at their goals, and several motion profiles."""
        return super().skip(problem) or _no_unit_moves(problem)


def _no_unit_moves(problem: Problem) -> str | None:
    """Return the reason why a problem needs more than unit moves to goals where robots stay, or None."""
    if problem.rules.at_goal != "stay":
        return "does not support robots that disappear at their goals"
    if len(np.unique(problem.profile)) > 1:
        return "does not support several motion profiles, not even equal ones"
    return None
