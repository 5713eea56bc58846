"""Which problems the planners can be given that move all robots tick by tick."""

import numpy as np

from mrpbench_core.model.problem import Problem


def no_unit_moves(problem: Problem) -> str | None:
    """Why a problem without further features is still more than unit moves to goals to stay at, or None."""
    if problem.rules.at_goal != "stay":
        return "does not know robots that disappear at their goals"
    if len(np.unique(problem.profile)) > 1:
        return "does not know several motion profiles, not even equal ones"
    return None
