"""The solvers by name, each with what its name stands for."""

from collections.abc import Callable, Mapping
from typing import Any

from mrpbench_native import mapf

_FOCAL: dict[str, Any] = {
    "selection": "focal",
    "w": 1.2,
    "prioritize": False,
    "bypass": False,
    "heuristic": False,
    "target": False,
    "corridor": False,
    "rectangle": False,
    "flex": False,
    "incumbent_after": None,
    "distance_weight": 1.0,
    "conflict_weight": 0.0,
}
_EXPLICIT_ESTIMATION: dict[str, Any] = {
    "selection": "explicit_estimation",
    "w": 1.2,
    "prioritize": True,
    "bypass": True,
    "heuristic": True,
    "target": True,
    "corridor": True,
    "rectangle": True,
    "flex": False,
    "incumbent_after": 100_000,
    "distance_weight": 1.2,
    "conflict_weight": 20.0,
}
_ASSIGNING: dict[str, Any] = _EXPLICIT_ESTIMATION | {
    "selection": "focal",
    "heuristic": False,
    "incumbent_after": None,
}

ALGORITHMS: Mapping[str, tuple[Callable[..., mapf.Answer], dict[str, Any]]] = {
    "astar": (mapf.astar, {"heuristic": "exact"}),
    "cbs": (mapf.cbs, {}),
    "cbs_ta": (mapf.cbs, {"goal_choice": "ranked"}),
    "ecbs": (mapf.bounded_cbs, _FOCAL),
    "ecbs_ta": (mapf.bounded_cbs, _ASSIGNING | {"goal_choice": "ranked"}),
    "eecbs": (mapf.bounded_cbs, _EXPLICIT_ESTIMATION),
    "ita_cbs": (mapf.cbs, {"goal_choice": "by_node"}),
    "ita_ecbs": (mapf.bounded_cbs, _ASSIGNING | {"goal_choice": "by_node"}),
    "lacam": (
        mapf.lacam,
        {
            "objective": "flowtime",
            "swap": True,
            "prioritized": True,
            "guides": True,
            "star": True,
            "neighbourhoods": True,
            "iterations": None,
            "seed": 0,
        },
    ),
    "lns": (
        mapf.lns,
        {"objective": "flowtime", "initial": "either", "neighbourhood": None, "iterations": None, "seed": 0},
    ),
    "pbs": (mapf.pbs, {}),
    "pibt": (mapf.pibt, {"swap": True, "steps": 0, "seed": 0}),
    "prioritized": (mapf.prioritized, {"order": "longest_first", "restarts": 1000, "seed": 0}),
}
"""Function and preset options. The planners of mrpbench by the same names have the same options, and say more."""
