"""Assigner by SciPy."""

from mrpbench_assigners_scipy.hungarian import Hungarian

__all__ = ["Hungarian"]
