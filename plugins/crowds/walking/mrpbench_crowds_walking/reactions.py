"""The reactions of people to robots that HuNavSim has (N. Pérez-Higueras et al., "HuNavSim", RA-L 8, 2023)."""

from typing import Literal, NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Float

Reaction = Literal["regular", "impassive", "surprised", "curious", "scared", "threatening"]
AS_PEOPLE, AS_OBSTACLES, NOT_AT_ALL = 0, 1, 2
"""How a person regards robots in its forces."""
SIGHT = {"surprised": 4.0, "curious": 10.0, "scared": 3.0, "threatening": 4.0}
"""Metres between centres within which they see a robot."""
PATIENCE = {"surprised": 30.0, "curious": 30.0, "scared": 40.0, "threatening": 40.0}
"""Seconds after which they are done; only `scared` begins again."""
VIEW = np.pi / 2 + 0.17
"""Radians to both sides."""


class Act(NamedTuple):
    """What a person does about a robot, instead of walking to its goal."""

    velocity: Float
    """f8[2] wanted, m/s."""
    push: Float
    """f8[2] further acceleration, m/s²."""
    looks: float
    """Direction in which it looks, radians."""


def nearest_seen(place: Float, yaw: float, robots: Float, reach: float) -> int:
    """The index of the nearest robot of f8[n,2] in view and within `reach` metres, -1 = none."""
    if not len(robots):
        return -1
    offset = robots - place
    distance = np.hypot(*offset.T)
    bearing = np.arctan2(offset[:, 1], offset[:, 0]) - yaw
    bearing = (bearing + np.pi) % (2 * np.pi) - np.pi
    distance[(np.abs(bearing) > VIEW) | (distance > reach)] = np.inf
    nearest = int(distance.argmin())
    return nearest if np.isfinite(distance[nearest]) else -1


def react(reaction: Reaction, place: Float, robot: Float, robot_yaw: float, gap: float, to_goal: Float) -> Act:
    """What a person at `place` f8[2] does about the robot at `robot` f8[2], whose body is `gap` metres away.

    `to_goal` f8[2] is the velocity with which the person would walk to its goal.
    """
    offset = robot - place
    distance = float(np.hypot(*offset))
    ahead = offset / distance if distance > 0 else np.array([1.0, 0.0])
    looks, still = float(np.arctan2(ahead[1], ahead[0])), np.zeros(2)
    if reaction == "surprised":
        return Act(still, still, looks)
    if reaction == "curious":
        return Act(still if distance <= 1.5 else ahead * 1.8 * distance / 10, still, looks)
    if reaction == "scared":
        speed = float(np.hypot(*to_goal))
        slow = to_goal * min(1.0, 0.6 / speed) if speed > 0 else still
        away = -ahead * 20 * 0.2 / max(gap, 0.2)
        return Act(slow, away, float(np.arctan2(slow[1], slow[0])) if speed > 0 else looks)
    front = robot + 1.1 * np.array([np.cos(robot_yaw), np.sin(robot_yaw)])  # threatening: it blocks the way
    way = front - place
    left = float(np.hypot(*way))
    return Act(still if left <= 0.05 or (distance <= 1.2 and left <= 0.3) else way / left * 2.0, still, looks)
