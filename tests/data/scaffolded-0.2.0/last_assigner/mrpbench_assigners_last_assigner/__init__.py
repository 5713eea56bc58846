"""Assigner last_assigner for mrpbench."""

from mrpbench_assigners_last_assigner.last_assigner import LastAssigner

__all__ = ["LastAssigner"]
