"""Planner last_program for mrpbench."""

from mrpbench_planners_last_program.last_program import LastProgram

__all__ = ["LastProgram"]
