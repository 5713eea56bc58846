"""Planner last_planner for mrpbench."""

from mrpbench_planners_last_planner.last_planner import LastPlanner

__all__ = ["LastPlanner"]
