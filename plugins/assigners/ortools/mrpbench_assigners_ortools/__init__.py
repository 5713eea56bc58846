"""Assigners by Google OR-Tools."""

from mrpbench_assigners_ortools.mip import OrToolsMip
from mrpbench_assigners_ortools.sat import OrToolsSat

__all__ = ["OrToolsMip", "OrToolsSat"]
