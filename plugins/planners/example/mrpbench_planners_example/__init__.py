"""Example planner for mrpbench."""

from mrpbench_planners_example.cooperative_astar import Example

__all__ = ["Example"]
