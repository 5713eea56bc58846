"""The solvers by name, each with what its name stands for."""

from collections.abc import Callable, Mapping
from typing import Any

from mrpbench_native import mapf

ALGORITHMS: Mapping[str, tuple[Callable[..., mapf.Answer], dict[str, Any]]] = {
    "astar": (mapf.astar, {"heuristic": "exact"}),
    "cbs": (mapf.cbs, {}),
    "prioritized": (mapf.prioritized, {"order": "longest_first", "restarts": 100, "seed": 0}),
}
"""Function and preset options. The planners of mrpbench by the same names have the same options, and say more."""
