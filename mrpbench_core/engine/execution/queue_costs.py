"""Seconds that robots need from place to place, for assigners that are called again and again."""

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from mrpbench_core.api.assigner import Cost
from mrpbench_core.checking.reachability import round_trips
from mrpbench_core.engine.execution.destinations import Errand
from mrpbench_core.engine.travel import through, travel_ticks
from mrpbench_core.model.common.arrays import Bool, Float, Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.roadmap import Roadmap

TABLES = 2048
"""Tables of travel times to one vertex that are kept."""
WAYS = 16384
"""Ways through errands whose times are kept."""


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
            min(
                (speed for speed, number_of_robot in zip(speeds, profile, strict=True) if number_of_robot == number),
                default=1.0,
            )
            for number in range(len(models))
        ]
        self._to, self.along = lru_cache(TABLES)(self._search), lru_cache(WAYS)(self._along)

    def joined(self, profile: int, start: Int, goal: Int) -> Bool:
        """Tell, bool[k,l], where there are ways from vertices `start` i8[k] to `goal` i8[l] and back."""
        label = self.labels[profile]
        reachable: Bool = label[start][:, None] == label[goal][None, :]
        return reachable

    def seconds(self, profile: int, start: Int, goal: Int) -> Float:
        """Seconds f8[k,l] from vertices `start` i8[k] to `goal` i8[l]; inf where there is no way back."""
        able = self.joined(profile, start, goal)
        if self._kind == "roadmap":
            seconds = np.array([self._to(profile, int(end))[start] for end in goal]).reshape(len(goal), len(start)).T
        else:
            span = np.abs(self._roadmap.position[goal][None] - self._roadmap.position[start][:, None])
            metres = span.sum(-1) if self._kind == "manhattan" else np.hypot(span[..., 0], span[..., 1])
            seconds = metres / self._speed[profile]
        return np.where(able, seconds, np.inf)

    def _along(self, profile: int, sets: tuple[GoalSet, ...]) -> Float:
        """Seconds f8[p,q] from each vertex of the first set, through one of each further set, to each of the last."""
        here = np.where(np.eye(len(sets[0])), 0.0, np.inf)
        return through(here, (self.seconds(profile, np.array(a), np.array(b)) for a, b in pairwise(sets)))

    def nearest_first(self, way: Sequence[Errand], start: int) -> Sequence[Errand]:
        """Sort the places of errands that a robot does in order by the time on the roadmap to get there.

        The way begins at `start`, then at the first place of the errand before. Places without a way are left out.
        """
        if len(way) == 1 and len(way[0].yaws) == 1:  # the usual case
            return way
        errands_in_order = []
        for errand in way:
            if len(errand.yaws) > 1:
                profile = int(self.profile[errand.robot])
                seconds = {vertex: float(self._to(profile, vertex)[start]) for vertex in errand.yaws}
                there = sorted((it for it in seconds if seconds[it] < np.inf), key=seconds.__getitem__)
                errand = errand.at(there or errand.yaws)
            start = next(iter(errand.yaws))
            errands_in_order.append(errand)
        return errands_in_order

    def _search(self, profile: int, goal: int) -> Float:
        """Seconds f8[V] from every vertex to `goal`."""
        vertices = range(len(self._roadmap.position))
        ticks: Float = travel_ticks(self._roadmap, profile, [goal], vertices)[0] * self._roadmap.tick
        return ticks
