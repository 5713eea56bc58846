"""The planner `external`: any solver that reads MovingAI files and writes paths."""

from mrpbench_planners_external.planner import External

__all__ = ["External"]
