"""Planes of PRIMAL and SCRIMP, in the order and with the windows of their published environments.

Sartoretti et al., "PRIMAL: Pathfinding via Reinforcement and Imitation Multi-Agent Learning", RA-L 2019
(gsartoretti/PRIMAL at 838cd9dc). Wang et al., "SCRIMP: Scalable Communication for Reinforcement- and
Imitation-Learning-Based Multi-Agent Pathfinding", IROS 2023 (marmotlab/SCRIMP at 0a9451a3), with the heuristic channels
of Ma, Luo and Ma, "Distributed Heuristic Multi-Agent Path Finding with Communication", ICRA 2021.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api import Bool, Int
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.maps import FAR
from mrpbench_policies.observations.observation import Field, Observation


class Primal(Observation):
    """`observation` f4[4,side,side], and `goal` f4[3].

    The planes are 1 at robots, the observer included; at its own goal if it is in the window; at the goals of the other
    robots in the window, moved onto its border where they lie outside; and at obstacles, which are everywhere outside
    of the map. `goal` is the unit vector to the own goal (row, column), 0 if the robot is there, and its Euclidean
    distance in cells. A window has `2 * radius` cells a side, of which `radius` are above and left of the robot.
    """

    def __init__(self, radius: int = 5) -> None:
        super().__init__(radius)
        self.side = 2 * radius

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
        maps, place, radius, side = state.maps, state.place.ravel(), self.radius, self.side
        robots = np.zeros(len(maps.blocked), np.float32)
        robots[state.place[state.active]] = 1.0
        planes[:, 0] = maps.windows(robots, place, radius)[:, :side, :side]
        cells, goals = maps.cells(state.place), maps.cells(state.goal)
        own = (goals - cells).reshape(-1, 2) + radius
        (near,) = self._in_window(own).nonzero()
        planes[near, 1, own[near, 0], own[near, 1]] = 1.0
        seen = self._in_window(cells[:, None] - cells[:, :, None] + radius) & state.active[:, None]
        environment, robot, other = np.nonzero(seen & ~np.eye(state.place.shape[1], dtype=bool))
        away = np.clip(goals[environment, other] - cells[environment, robot] + radius, 0, side - 1)
        planes[environment * state.place.shape[1] + robot, 2, away[:, 0], away[:, 1]] = 1.0
        obstacles = (maps.blocked | maps.outside).astype(np.float32)
        planes[:, 3] = maps.windows(obstacles, place, radius)[:, :side, :side]

    def _in_window(self, cell: Int) -> Bool:
        """Tell which cells [...,2], counted from the first one of a window, are in it."""
        inside: Bool = np.all((cell >= 0) & (cell < self.side), axis=-1)
        return inside


class Scrimp(Primal):
    """`observation` f4[8,side,side], and `goal` f4[3].

    The first four planes and `goal` are those of `Primal`; the others are 1 at the cells from which up, down, left and
    right lead nearer to the robot's own goal. A window has `2 * radius + 1` cells a side. The vector of SCRIMP has the
    three numbers of `goal`, then two rewards of its training, the distance from places visited before and the last
    action, which are not part of this one; its robots also exchange messages.
    """

    def __init__(self, radius: int = 5) -> None:
        super().__init__(radius)
        self.side = 2 * radius + 1

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:
        """Return two arrays."""
        return {**super().fields(shape), "observation": Field("f4", (8, self.side, self.side), 0.0, 1.0)}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots."""
        planes = np.zeros((state.place.size, 8, self.side, self.side), np.float32)
        self._draw(state, planes)
        maps = state.maps
        reach = np.arange(-self.radius, self.radius + 1)
        window = reach[:, None] * maps.width + reach
        around = maps.offset[1:, None, None] + window
        local = state.place.ravel() % maps.size
        for robot, (goal, here) in enumerate(zip(state.goal.ravel().tolist(), local.tolist(), strict=True)):
            table = maps.distances(goal)
            steps = table[here + window]
            planes[robot, 4:] = (table.take(here + around, mode="wrap") < steps) & (steps < FAR)
        return {"observation": planes, "goal": directions(state)}


def directions(state: FleetState) -> NDArray[np.float32]:
    """Return f4[b*n,3]: the unit vector (row, column) from each robot to its goal, 0 at the goal, and the distance."""
    away = (state.maps.cells(state.goal) - state.maps.cells(state.place)).reshape(-1, 2).astype(np.float32)
    distance = np.sqrt((away**2).sum(axis=1))
    return np.column_stack([away / np.maximum(distance, 1.0)[:, None], distance])
