"""The topics a bag can hold, and choosing among them by pattern."""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from typing import Any

FLEET = (
    "/clock",
    "/contacts",
    "/door_states",
    "/events",
    "/facilities",
    "/fleet_states",
    "/goals",
    "/lift_states",
    "/map",
    "/movers",
    "/navigation_graph",
    "/people",
    "/people_markers",
    "/progress",
    "/robots",
    "/routes",
    "/run",
    "/run_data",
    "/tf",
    "/tf_static",
)
"""Once per bag; further levels have `/map_1`, `/map_2`, ..."""
ROBOT = ("amcl_pose", "cmd_vel", "goal_pose", "ground_truth", "map", "odom", "plan", "scan")
"""Once per robot: `/robot_0/odom`."""
MANY = 1000
"""Patterns are tried on a fleet (and a house) of this size: which robots there are is not known yet."""


def selected(name: str, patterns: Sequence[str]) -> bool:
    """Tell whether a topic is wanted; patterns are those of shells."""
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def check_patterns(_instance: object, _attribute: Any, patterns: Sequence[str]) -> None:
    """Validate the option `topics`.

    Raises:
        ValueError: a pattern that no topic of any run matches.
    """
    names = [*FLEET, *(f"/map_{index}" for index in range(MANY))]
    names += [f"/robot_{index}/{name}" for index in range(MANY) for name in ROBOT]
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in names):
            known = ", ".join((*FLEET, *(f"/robot_*/{name}" for name in ROBOT)))
            raise ValueError(f"no topic matches '{pattern}'; there are {known}")
