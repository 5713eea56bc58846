"""The tokens of MAPF-GPT (Andreychuk et al., "MAPF-GPT: Imitation Learning for Multi-Agent Pathfinding at Scale", AAAI
2025).
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api import Int
from mrpbench_policies.fleet_state import MEMORY, FleetState
from mrpbench_policies.maps import FAR
from mrpbench_policies.observations.observation import Field, Observation

NEAREST = 13
"""Robots that the tokens of one robot describe, itself included."""
PER_ROBOT = 10
LENGTH = 256
CLIP = 20
"""Numbers from -20 to 20 have tokens of their own, 0 to 40."""
NO_WAY, LESS, MORE = 41, 42, 43
"""Cost-to-go: blocked or unreachable; below -20; above 20."""
NO_ACTION = 44
"""The token of `none yet`; those of the five actions follow."""
NEARER = 50
"""The token of the mask 0000; up, down, left and right count 8, 4, 2 and 1 where they lead nearer to the goal."""
PADDING = 66


class MapfGptTokens(Observation):
    """i8[256]: 121 of cost-to-go, ten for each of the 13 nearest robots in the window, and padding."""

    def __init__(self, radius: int = 5) -> None:
        super().__init__(radius)
        if self.side**2 + NEAREST * PER_ROBOT > LENGTH:
            raise ValueError("tokens of MAPF-GPT have windows of a radius of at most 5")

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:  # noqa: ARG002
        """Return one array, `tokens`."""
        return {"tokens": Field("i8", (LENGTH,), 0, PADDING)}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the tokens of all robots."""
        maps, (environments, robots) = state.maps, state.place.shape
        tokens = np.full((environments * robots, LENGTH), PADDING, np.int64)
        tokens[:, : self.side**2], mask = self._ways(state)
        history = state.chosen.astype(np.int64) + NO_ACTION + 1
        cells, goals = maps.cells(state.place), maps.cells(state.goal)
        mask = mask.reshape(environments, robots)
        begin = self.side**2
        for environment in range(environments):
            cell, goal = cells[environment], goals[environment]
            others = np.flatnonzero(state.active[environment])
            for robot in range(robots):
                near = self._nearest(robot, cell, others)
                described = np.concatenate(
                    [
                        cell[near] - cell[robot] + CLIP,
                        np.clip(goal[near] - cell[robot], -CLIP, CLIP) + CLIP,
                        history[environment, near],
                        mask[environment, near, None],
                    ],
                    axis=1,
                ).ravel()
                tokens[environment * robots + robot, begin : begin + len(described)] = described
        return {"tokens": tokens}

    def _nearest(self, robot: int, cell: Int, others: Int) -> Int:
        """The robots in the window, nearest first, the observer before all others."""
        away = np.abs(cell[others] - cell[robot])
        inside = others[(away <= self.radius).all(axis=1)]
        distance = np.abs(cell[inside] - cell[robot]).sum(axis=1)
        distance[inside == robot] = -1
        nearest: Int = inside[np.argsort(distance, kind="stable")][:NEAREST]
        return nearest

    def _ways(self, state: FleetState) -> tuple[Int, Int]:
        """Tokens i8[k,side*side] of cost-to-go, and of the mask i8[k] of the moves that lead nearer."""
        maps, place = state.maps, state.place.ravel() % state.maps.size
        reach = np.arange(-self.radius, self.radius + 1)
        window = (reach[:, None] * maps.width + reach).ravel()
        costs = np.empty((len(place), len(window)), np.int64)
        around = np.empty((len(place), 5), np.int64)
        for row, (goal, here) in enumerate(zip(state.goal.ravel().tolist(), place.tolist(), strict=True)):
            table = maps.distances(goal)
            costs[row], around[row] = table[here + window], table[here + maps.offset]
        more = costs - around[:, :1]
        tokens = np.where(more > CLIP, MORE, np.where(more < -CLIP, LESS, more + CLIP))
        tokens[costs == FAR] = NO_WAY
        nearer = around[:, 1:] < around[:, :1]
        return tokens, NEARER + nearer @ np.array([8, 4, 2, 1])


assert MEMORY == PER_ROBOT - 5, "two places, five actions and a mask describe a robot"
