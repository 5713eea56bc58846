"""The goal and progress checkers of Nav2, by its names, and what a Nav2 parameter file says of them (lyrical 1.5)."""

from typing import Any

import attrs

from mrpbench_core.api.nav2 import check_parameter, plugin_ids
from mrpbench_core.files.nav2 import Nav2Block

_SIMPLE = {"xy_goal_tolerance": 0.25, "yaw_goal_tolerance": 0.25, "stateful": True}
_MOVED = {"required_movement_radius": 0.5, "movement_time_allowance": 10.0}
_KINDS: dict[str, dict[str, dict[str, Any]]] = {
    "goal_checker": {
        "SimpleGoalChecker": _SIMPLE,
        "StoppedGoalChecker": _SIMPLE | {"trans_stopped_velocity": 0.25, "rot_stopped_velocity": 0.25},
        "PositionGoalChecker": {"xy_goal_tolerance": 0.25, "stateful": True},
    },
    "progress_checker": {
        "SimpleProgressChecker": _MOVED,
        "PoseProgressChecker": _MOVED | {"required_movement_angle": 0.5},
    },
}
"""The checkers of each kind, with Nav2's defaults of their parameters."""
_NOT_USED = (
    *("path_length_tolerance", "symmetric_yaw_tolerance"),  # a robot arrives only when it has passed all its waypoints
    *(name for kind in _KINDS.values() for parameters in kind.values() for name in parameters),
)
"""Parameters of Nav2's checkers that have no effect here, or not on the checker that is chosen."""


def parameters_of(checker: str) -> frozenset[str]:
    """Return the names of the parameters of a checker."""
    return frozenset(name for kind in _KINDS.values() for name in kind.get(checker, ()))


def several_in(server: Nav2Block) -> list[str]:
    """Return a note for each kind of which a Nav2 controller server has several checkers."""
    listed = [plugin_ids(server, kind) for kind in _KINDS]
    return [f"{server.title}: of {', '.join(ids)} the first is used" for ids in listed if len(ids) > 1]


def from_nav2(server: Nav2Block, options: type[attrs.AttrsInstance]) -> dict[str, Any]:
    """Return the names and parameters of the checkers of a Nav2 controller server, and `failure_tolerance`.

    Args:
        server: its parameters. Of several checkers of a kind the first is taken; Nav2's defaults fill what is missing.
        options: class with an option of each name, whose validator checks the value.

    Raises:
        InputError: a checker, a parameter or a value is not supported.
    """
    tolerance = server.take("failure_tolerance", float, 0.0)
    chosen_checkers: dict[str, Any] = {"failure_tolerance": tolerance if tolerance >= 0 else float("inf")}  # as in Nav2
    for kind, checkers in _KINDS.items():
        block = server.within(plugin_ids(server, kind)[0])
        chosen_checkers[kind] = block.take("plugin", str, next(iter(checkers))).replace("/", "::").rpartition("::")[2]
        if chosen_checkers[kind] not in checkers:
            raise block.error(
                f"{chosen_checkers[kind]!r} is not supported", "plugin", hint=f"supported: {', '.join(checkers)}"
            )
        for name, default in checkers[chosen_checkers[kind]].items():
            chosen_checkers[name] = block.take(name, type(default), default)
            check_parameter(getattr(attrs.fields(options), name), chosen_checkers[name], block, name)
        block.not_used(*_NOT_USED)
    return chosen_checkers
