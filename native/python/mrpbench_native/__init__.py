"""The parts of mrpbench in C++. `mapf`: multi-agent path finding; `sim`: robots, contacts and lidars in the plane;
`amcl`: localisation; `slam`: localisation and mapping; `local`: costmaps and local control. `solve` plans paths from a
notebook.
"""

from mrpbench_native.algorithms import ALGORITHMS, describe, options_of
from mrpbench_native.roadmaps import DirectedGraph, Grid
from mrpbench_native.solving import Solution, solve

__all__ = ["ALGORITHMS", "DirectedGraph", "Grid", "Solution", "describe", "options_of", "solve"]
