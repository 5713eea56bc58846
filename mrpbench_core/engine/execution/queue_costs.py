"""Seconds that robots need from place to place, for assigners that are called again and again."""

from functools import lru_cache
from itertools import pairwise

import numpy as np

from mrpbench_core.api.assigner import Cost
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.engine.travel import travel_ticks
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap

TABLES = 2048
"""Tables of travel times to one vertex that are kept."""


class QueueCosts:
    """Durations of ways between vertices, of the kind that the assigner asks for.

    Args:
        kind: of costs; straight lines and Manhattan distances are driven at the greatest speed of the slowest robot of
            a motion profile.
        roadmap: gives the vertices.
        fleet: gives motion profiles and speeds.
    """

    def __init__(self, kind: Cost, roadmap: Roadmap, fleet: Fleet) -> None:
        self._kind, self._roadmap = kind, roadmap
        models, profile = fleet.profiles
        self.profile: Int = np.array(profile, np.int64)
        self.labels = [round_trips(roadmap, number) for number in range(len(models))]
        """For each motion profile: equal for vertices between which it can drive both ways."""
        speeds = [robot.max_speed for robot in fleet.robots]
        self._speed = [
            min((speed for speed, own in zip(speeds, profile, strict=True) if own == number), default=1.0)
            for number in range(len(models))
        ]
        self._to = lru_cache(TABLES)(self._search)

    def joined(self, profile: int, start: Int, goal: Int) -> Bool:
        """Tell, bool[k,l], where there are ways from vertices `start` i8[k] to `goal` i8[l] and back."""
        label = self.labels[profile]
        found: Bool = label[start][:, None] == label[goal][None, :]
        return found

    def seconds(self, profile: int, start: Int, goal: Int) -> Float:
        """Seconds f8[k,l] from vertices `start` i8[k] to `goal` i8[l]; inf where there is no way back."""
        able = self.joined(profile, start, goal)
        if self._kind == "roadmap":
            found = np.array([self._to(profile, int(end))[start] for end in goal]).reshape(len(goal), len(start)).T
        else:
            span = np.abs(self._roadmap.position[goal][None] - self._roadmap.position[start][:, None])
            metres = span.sum(-1) if self._kind == "manhattan" else np.hypot(span[..., 0], span[..., 1])
            found = metres / self._speed[profile]
        return np.where(able, found, np.inf)

    def along(self, profile: int, vertices: tuple[int, ...]) -> float:
        """Seconds through vertices in order."""
        legs = pairwise(vertices)
        return float(sum(self.seconds(profile, np.array([a]), np.array([b]))[0, 0] for a, b in legs))

    def _search(self, profile: int, goal: int) -> Float:
        """Seconds f8[V] from every vertex to `goal`."""
        vertices = range(len(self._roadmap.position))
        ticks: Float = travel_ticks(self._roadmap, profile, [goal], vertices)[0] * self._roadmap.tick
        return ticks
