"""Robots and lidars in the plane, in C++."""

from mrpbench_simulators_planar.simulator import Planar

__all__ = ["Planar"]
