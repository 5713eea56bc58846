"""The observation of the policy that this distribution ships: windows of obstacles, robots and ways to the goal."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.maps import FAR
from mrpbench_policies.observations.observation import Field, Observation, agents


class CostToGo(Observation):
    """f4[4,side,side]: obstacles, robots, how much nearer the goal a cell is than the robot, and next cells of others.

    The third window is the distance of the own cell less that of each cell, divided by twice the radius, within -1 and
    1, and -1 where there is no way. The fourth counts for each cell the robots whose shortest ways lead there next, a
    robot with several such cells counting in parts; the robot itself does not count.
    """

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:  # noqa: ARG002
        """Return one array, `observation`."""
        return {"observation": Field("f4", (4, self.side, self.side), -1.0, 4.0)}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the windows of all robots."""
        maps, place = state.maps, state.place.ravel()
        rows = np.empty((len(place), 4, self.side, self.side), np.float32)
        rows[:, 0] = maps.windows(maps.obstacles, place, self.radius)
        rows[:, 1] = maps.windows(agents(state), place, self.radius)
        reach = np.arange(-self.radius, self.radius + 1)
        window = reach[:, None] * maps.width + reach
        local = place % maps.size
        next_cells, share = np.zeros((len(place), 5), np.int64), np.zeros((len(place), 5), np.float32)
        for robot, (goal, here) in enumerate(zip(state.goal.ravel().tolist(), local.tolist(), strict=True)):
            table = maps.distances(goal)
            nearer = (table[here] - table[here + window]) / np.float32(2 * self.radius)
            rows[robot, 2] = np.where(table[here + window] == FAR, -1.0, np.clip(nearer, -1.0, 1.0))
            around = table[here + maps.offset]
            best = around < around[0] if around[0] else np.arange(5) == 0
            share[robot] = best / max(1, np.count_nonzero(best))
        next_cells = place[:, None] + maps.offset
        share[~state.active.ravel()] = 0.0
        wanted = np.bincount(next_cells.ravel(), share.ravel(), len(maps.blocked)).astype(np.float32)
        rows[:, 3] = maps.windows(wanted, place, self.radius)
        moves = np.array([(self.radius, self.radius)]) + np.array([(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)])
        rows[:, 3, moves[:, 0], moves[:, 1]] -= share
        return {"observation": rows}
