"""Finds robots by the names of topics and frames."""

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase

PLACE = "{robot}"
LONE = "robot"
"""Name of the robot if its topics contain no name."""


def robot_in(name: str, patterns: Iterable[str]) -> str | None:
    """Return the robot of a topic or frame, by the first pattern that matches."""
    for pattern in patterns:
        before, place, after = pattern.partition(PLACE)
        match = re.fullmatch(re.escape(before) + (r"([^/]+)" if place else "") + re.escape(after), name)
        if match:
            return match[1] if place else LONE
    return None


def without_robot(patterns: Iterable[str]) -> tuple[str, ...]:
    """Return the patterns of a single robot: `/odom` for `/{robot}/odom`."""
    return tuple(pattern.replace("/" + PLACE, "").replace(PLACE + "/", "") for pattern in patterns)


def wanted(robot: str, chosen: tuple[str, ...]) -> bool:
    """Tell whether names or shell patterns choose a robot; () = all."""
    return not chosen or any(fnmatchcase(robot, pattern) for pattern in chosen)


def natural(name: str) -> list[tuple[int, str]]:
    """Sorts `robot_2` before `robot_10`."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"([0-9]+)", name)]
