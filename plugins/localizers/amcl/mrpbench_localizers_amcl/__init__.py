"""Adaptive Monte Carlo localisation, in C++."""

from mrpbench_localizers_amcl.localizer import Amcl

__all__ = ["Amcl"]
