"""The observations of POGEMA 1.4, which tests compare with those of the package element by element.

Skrynnik et al., "POGEMA: A Benchmark Platform for Cooperative Multi-Agent Pathfinding", ICLR 2025.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.observations.observation import Field, Observation, agents

FARTHEST = 1024
"""Bound of coordinates, as in POGEMA."""


class PogemaDefault(Observation):
    """`default`: f4[3,side,side], the obstacles, the robots, and the goal, which is projected onto the border of the
    window where it lies outside.
    """

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:  # noqa: ARG002
        """Return one array, `observation`."""
        return {"observation": Field("f4", (3, self.side, self.side), 0.0, 1.0)}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the windows of all robots."""
        windows = np.empty((state.place.size, 3, self.side, self.side), np.float32)
        state.maps.native.pogema(state.active & ~state.overwritten, state.place, state.goal, self.radius, windows)
        return {"observation": windows}


class PogemaPomapf(Observation):
    """`POMAPF`: the windows `obstacles` and `agents`, and `xy` and `target_xy` relative to where the robot started."""

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:  # noqa: ARG002
        """Return four arrays."""
        window, place = Field("f4", (self.side, self.side), 0.0, 1.0), Field("i8", (2,), -FARTHEST, FARTHEST)
        return {"obstacles": window, "agents": window, "xy": place, "target_xy": place}

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots; places are rows and columns."""
        maps, place = state.maps, state.place.ravel()
        start = maps.cells(state.start.ravel())
        return {
            "obstacles": maps.windows(maps.obstacles, place, self.radius),
            "agents": maps.windows(agents(state), place, self.radius),
            "xy": maps.cells(place) - start,
            "target_xy": maps.cells(state.goal.ravel()) - start,
        }


class PogemaMapf(PogemaPomapf):
    """`MAPF`: `POMAPF`, and the whole map with a margin of `radius` cells, and places on it."""

    def fields(self, shape: tuple[int, int]) -> Mapping[str, Field]:
        """Return seven arrays."""
        whole = Field("f8", (shape[0] + 2 * self.radius, shape[1] + 2 * self.radius), 0.0, 1.0)
        place = Field("i8", (2,), 0, FARTHEST)
        return {
            **super().fields(shape),
            "global_obstacles": whole,
            "global_xy": place,
            "global_target_xy": place,
        }

    def observe(self, state: FleetState) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of all robots; the map is the same array for all robots of an environment."""
        maps, (_, robots) = state.maps, state.place.shape
        whole = maps.blocked.reshape(maps.count, maps.height, maps.width).astype(np.float64)
        return {
            **super().observe(state),
            "global_obstacles": whole.repeat(robots, axis=0),
            "global_xy": maps.cells(state.place.ravel()) + maps.margin,
            "global_target_xy": maps.cells(state.goal.ravel()) + maps.margin,
        }
