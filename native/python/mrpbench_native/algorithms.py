"""The solvers by name, each with what its name stands for."""

from collections.abc import Callable, Mapping
from typing import Any

from mrpbench_native import mapf

ALGORITHMS: Mapping[str, tuple[Callable[..., mapf.Answer], dict[str, Any]]] = {
    "astar": (mapf.astar, {"heuristic": "exact"}),
    "cbs": (mapf.cbs, {}),
    "ecbs": (
        mapf.bounded_cbs,
        {
            "selection": "focal",
            "w": 1.2,
            "prioritize": False,
            "bypass": False,
            "heuristic": False,
            "target": False,
            "corridor": False,
            "rectangle": False,
            "flex": False,
            "distance_weight": 1.0,
            "conflict_weight": 0.0,
        },
    ),
    "eecbs": (
        mapf.bounded_cbs,
        {
            "selection": "explicit_estimation",
            "w": 1.2,
            "prioritize": True,
            "bypass": True,
            "heuristic": True,
            "target": True,
            "corridor": True,
            "rectangle": True,
            "flex": False,
            "distance_weight": 1.2,
            "conflict_weight": 20.0,
        },
    ),
    "lacam": (
        mapf.lacam,
        {"objective": "flowtime", "swap": True, "star": True, "neighbourhoods": True, "iterations": None, "seed": 0},
    ),
    "lns": (
        mapf.lns,
        {"objective": "flowtime", "initial": "either", "neighbourhood": 8, "iterations": None, "seed": 0},
    ),
    "pbs": (mapf.pbs, {}),
    "pibt": (mapf.pibt, {"swap": True, "steps": 0, "seed": 0}),
    "prioritized": (mapf.prioritized, {"order": "longest_first", "restarts": 1000, "seed": 0}),
}
"""Function and preset options. The planners of mrpbench by the same names have the same options, and say more."""
