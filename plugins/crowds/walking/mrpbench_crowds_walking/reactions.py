"""The reactions of people to robots that HuNavSim has (N. Pérez-Higueras et al., "HuNavSim", RA-L 8, 2023)."""

from typing import Literal, NamedTuple

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int

Reaction = Literal["regular", "impassive", "surprised", "curious", "scared", "threatening"]
AS_PEOPLE, AS_OBSTACLES, NOT_AT_ALL = 0, 1, 2
"""How a person regards robots in its forces."""
SIGHT = {"surprised": 4.0, "curious": 10.0, "scared": 3.0, "threatening": 4.0}
"""Metres between centres within which they see a robot."""
PATIENCE = {"surprised": 30.0, "curious": 30.0, "scared": 40.0, "threatening": 40.0}
"""Seconds after which they are done; only `scared` begins again."""
VIEW = np.pi / 2 + 0.17
"""Radians to both sides."""


class Acts(NamedTuple):
    """What k people do about robots, instead of walking to their goals."""

    velocity: Float
    """f8[k,2] wanted, m/s."""
    push: Float
    """f8[k,2] further accelerations, m/s²."""
    looks: Float
    """f8[k] directions in which they look, radians."""


def nearest_seen(place: Float, yaw: Float, robots: Float, reach: float) -> Int:
    """The indices i8[k] of the nearest robots of f8[n,2] in view and within `reach` metres, -1 = none.

    Args:
        place: f8[k,2] metres, where the people are.
        yaw: f8[k] radians, where they look.
        robots: f8[n,2] metres.
        reach: Metres between centres.
    """
    if not len(robots):
        return np.full(len(place), -1)
    offset = robots - place[:, None]
    distance = np.hypot(offset[..., 0], offset[..., 1])
    distance[distance > reach] = np.inf
    person, robot = np.nonzero(distance < np.inf)
    bearing = np.arctan2(offset[person, robot, 1], offset[person, robot, 0]) - yaw[person]
    hidden = np.abs((bearing + np.pi) % (2 * np.pi) - np.pi) > VIEW
    distance[person[hidden], robot[hidden]] = np.inf
    return np.where(np.isfinite(distance.min(axis=1)), distance.argmin(axis=1), -1)


def react(reaction: Reaction, place: Float, robot: Float, gap: Float, to_goal: Float) -> Acts:
    """What people at `place` f8[k,2] do about robots at `robot` f8[k,3], whose bodies are `gap` f8[k] metres away.

    `to_goal` f8[k,2] are the velocities with which they would walk to their goals.
    """
    offset = robot[:, :2] - place
    distance = _length(offset)
    ahead = np.divide(offset, distance, out=np.tile([1.0, 0.0], (len(place), 1)), where=distance > 0)
    looks, still = np.arctan2(ahead[:, 1], ahead[:, 0]), np.zeros_like(place)
    if reaction == "surprised":
        return Acts(still, still, looks)
    if reaction == "curious":
        return Acts(np.where(distance <= 1.5, 0.0, ahead * 1.8 * distance / 10), still, looks)
    if reaction == "scared":
        speed = _length(to_goal)
        slow = to_goal * np.minimum(1.0, 0.6 / np.maximum(speed, 0.6))
        away = -ahead * 20 * 0.2 / np.maximum(gap, 0.2)[:, None]
        return Acts(slow, away, np.where(speed[:, 0] > 0, np.arctan2(slow[:, 1], slow[:, 0]), looks))
    front = robot[:, :2] + 1.1 * np.column_stack([np.cos(robot[:, 2]), np.sin(robot[:, 2])])  # it blocks the way
    way = front - place
    left = _length(way)
    there = (left <= 0.05) | ((distance <= 1.2) & (left <= 0.3))
    return Acts(np.where(there, 0.0, way / np.maximum(left, 0.05) * 2.0), still, looks)


def _length(vector: Float) -> Float:
    """Lengths f8[k,1] of vectors f8[k,2]."""
    length: Float = np.hypot(vector[:, :1], vector[:, 1:])
    return length
