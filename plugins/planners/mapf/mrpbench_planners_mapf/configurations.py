"""Planners that move all robots from configuration to configuration."""

from typing import ClassVar

from mrpbench_core.model.planning.problem import Feature, Problem
from mrpbench_planners_mapf.recipe import SUPPORTED, NativePlanner


class ConfigurationPlanner(NativePlanner):
    """A planner for robots that have one goal each and stay there.

    Where moves take one tick, all robots move tick by tick. Elsewhere the planner decides in which order robots move,
    and each move starts as soon as those before it allow.
    """

    supports: ClassVar[frozenset[Feature]] = SUPPORTED - {Feature.GOAL_SETS} | {Feature.RESOURCES}

    def skip(self, problem: Problem) -> str | None:
        """See `Planner.skip`; also robots that disappear at their goals."""
        if problem.rules.at_goal != "stay":
            return "does not support robots that disappear at their goals"
        return super().skip(problem)
