"""Crowd last_crowd for mrpbench."""

from mrpbench_crowds_last_crowd.last_crowd import LastCrowd

__all__ = ["LastCrowd"]
