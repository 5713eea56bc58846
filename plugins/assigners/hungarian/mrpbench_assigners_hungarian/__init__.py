"""The optimal assigner in C++."""

from mrpbench_assigners_hungarian.hungarian import Hungarian

__all__ = ["Hungarian"]
