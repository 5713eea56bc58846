"""Robots by the names of topics and frames."""

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase

PLACE = "{robot}"
LONE = "robot"
"""What the robot is called where no name is in its topics."""


def robot_in(name: str, patterns: Iterable[str]) -> str | None:
    """The robot that a topic or frame is of, by the first pattern that fits."""
    for pattern in patterns:
        before, place, after = pattern.partition(PLACE)
        found = re.fullmatch(re.escape(before) + (r"([^/]+)" if place else "") + re.escape(after), name)
        if found:
            return found[1] if place else LONE
    return None


def without_robot(patterns: Iterable[str]) -> tuple[str, ...]:
    """The patterns of a robot that is alone: `/odom` for `/{robot}/odom`."""
    return tuple(pattern.replace("/" + PLACE, "").replace(PLACE + "/", "") for pattern in patterns)


def wanted(robot: str, chosen: tuple[str, ...]) -> bool:
    """Tell whether names or shell patterns choose a robot; () = all."""
    return not chosen or any(fnmatchcase(robot, pattern) for pattern in chosen)


def natural(name: str) -> list[tuple[int, str]]:
    """Sorts `robot_2` before `robot_10`."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"([0-9]+)", name)]
