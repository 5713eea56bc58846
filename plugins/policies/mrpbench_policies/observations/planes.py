"""Planes as PRIMAL and SCRIMP have them, by the descriptions in their papers.

Sartoretti et al., "PRIMAL: Pathfinding via Reinforcement and Imitation Multi-Agent Learning", RA-L 2019. Wang et al.,
"SCRIMP: Scalable Communication for Reinforcement- and Imitation-Learning-Based Multi-Agent Pathfinding", IROS 2023,
with the heuristic channels of Ma, Luo and Ma, "Distributed Heuristic Multi-Agent Path Finding with Communication", ICRA
2021.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api import Bool
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.maps import FAR
from mrpbench_policies.observations.observation import Field, Observation


class Primal(Observation):
    """`observation` f4[4,side,side], and `goal` f4[3].

    The planes are 1 at obstacles, which are everywhere outside of the map; at other robots; at the robot's own goal if
    it is in the window; and at the goals of the other robots in the window, moved onto its border where they lie
    outside. `goal` is the unit vector to the own goal (row, column), 0 if the robot is there, and its Euclidean
    distance in cells. The windows of PRIMAL have ten rows and columns, these have an odd number.
    """

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:
        """Return two arrays."""
        return {
            "observation": Field("f4", (4, self.side, self.side), 0.0, 1.0),
            "goal": Field("f4", (3,), -1.0, max(1.0, math.hypot(*shape))),
        }

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots."""
        planes = np.zeros((state.place.size, 4, self.side, self.side), np.float32)
        self._draw(state, planes)
        return {"observation": planes, "goal": directions(state)}

    def _draw(self, state: FleetState, planes: NDArray[np.float32]) -> None:
        """Write the four planes f4[k,4,side,side], which are 0."""
        maps, place, radius = state.maps, state.place.ravel(), self.radius
        planes[:, 0] = maps.windows((maps.blocked | maps.outside).astype(np.float32), place, radius)
        robots = np.zeros(len(maps.blocked), np.float32)
        robots[state.place[state.active]] = 1.0
        planes[:, 1] = maps.windows(robots, place, radius)
        planes[:, 1, radius, radius] = 0.0
        cells, goals = maps.cells(state.place), maps.cells(state.goal)
        own = (goals - cells).reshape(-1, 2)
        (near,) = (np.abs(own) <= radius).all(axis=1).nonzero()
        planes[near, 2, own[near, 0] + radius, own[near, 1] + radius] = 1.0
        environment, robot, other = self._seen(state).nonzero()
        away = np.clip(goals[environment, other] - cells[environment, robot], -radius, radius) + radius
        planes[environment * state.place.shape[1] + robot, 3, away[:, 0], away[:, 1]] = 1.0

    def _seen(self, state: FleetState) -> Bool:
        """Tell which other robots, bool[b,n,n], are in the window of each."""
        cells = state.maps.cells(state.place)
        away = np.abs(cells[:, :, None] - cells[:, None])
        seen = (away <= self.radius).all(axis=-1) & state.active[:, None]
        others: Bool = seen & ~np.eye(state.place.shape[1], dtype=bool)
        return others


class Scrimp(Primal):
    """`observation` f4[8,side,side], and `goal` f4[3].

    The first four planes are 1 at the cells from which up, down, left and right lead nearer to the robot's own goal;
    the others and `goal` are those of `Primal`. SCRIMP's vector also has the last rewards, the distance from places
    visited before and the last action, which belong to its training and are not part of this one.
    """

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:
        """Return two arrays."""
        return {**super().fields(shape), "observation": Field("f4", (8, self.side, self.side), 0.0, 1.0)}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots."""
        planes = np.zeros((state.place.size, 8, self.side, self.side), np.float32)
        self._draw(state, planes[:, 4:])
        maps = state.maps
        reach = np.arange(-self.radius, self.radius + 1)
        window = reach[:, None] * maps.width + reach
        around = maps.offset[1:, None, None] + window
        local = state.place.ravel() % maps.size
        for robot, (goal, here) in enumerate(zip(state.goal.ravel().tolist(), local.tolist(), strict=True)):
            table = maps.distances(goal)
            steps = table[here + window]
            planes[robot, :4] = (table.take(here + around, mode="wrap") < steps) & (steps < FAR)
        return {"observation": planes, "goal": directions(state)}


def directions(state: FleetState) -> NDArray[np.float32]:
    """Return f4[b*n,3]: the unit vector (row, column) from each robot to its goal, 0 at the goal, and the distance."""
    away = (state.maps.cells(state.goal) - state.maps.cells(state.place)).reshape(-1, 2).astype(np.float32)
    distance = np.sqrt((away**2).sum(axis=1))
    return np.column_stack([away / np.maximum(distance, 1.0)[:, None], distance])
