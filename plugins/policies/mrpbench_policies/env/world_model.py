"""Contract of depths: what becomes of the actions of robots in one step; and the first of them, the grid."""

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from mrpbench_core.api import Bool, Int
from mrpbench_policies.env.scenes import Scene
from mrpbench_policies.fleet_state import FleetState, soft
from mrpbench_policies.maps import Maps


class Steps(ABC):
    """Robots of b environments under way."""

    state: FleetState
    """A robot counts as being in the cell that it reached last."""
    moving: Bool
    """bool[b,n]: the robot is between two cells; its action in the next step is not regarded."""
    interventions: int = 0
    """Actions of robots that could act, and that did not begin because of walls or of other robots."""

    @abstractmethod
    def step(self, actions: Int) -> None:
        """Let a step pass, in which robots that are not `moving` begin actions i8[b,n]."""

    def close(self) -> None:  # noqa: B027 - most have nothing to close
        """Release all resources; may be called twice."""

    def lay(self, environment: int, scene: Scene) -> None:
        """Begin another scene in one environment, in the place of the one before."""
        state = self.state
        state.maps.lay(environment, scene.blocked)
        for name, cells in (("place", scene.start), ("start", scene.start), ("goal", scene.goal)):
            getattr(state, name)[environment] = state.maps.places_in(environment, cells)
        state.active[environment], state.overwritten[environment] = True, False
        state.chosen[environment] = -1
        self.moving[environment] = False


class Depth(ABC):
    """How robots move, from points on a grid to bodies."""

    batched: bool = True
    """False if it has one environment at a time."""

    @abstractmethod
    def begin(self, scenes: Sequence[Scene], margin: int, seed: int) -> Steps:
        """Put robots at the starts of scenes; maps have a `margin` for windows."""


def fleet_state(scenes: Sequence[Scene], margin: int) -> FleetState:
    """Return robots at the starts of scenes."""
    maps = Maps(np.stack([scene.blocked for scene in scenes]), margin)
    start, goal = (np.stack([getattr(scene, name) for scene in scenes]) for name in ("start", "goal"))
    return FleetState.at(maps, maps.places(start), maps.places(goal))


class Grid(Depth):
    """Points that move one cell in a step, all at once, by the rule `mrpbench_policies.fleet_state.soft`."""

    def begin(self, scenes: Sequence[Scene], margin: int, seed: int) -> Steps:  # noqa: ARG002 - nothing is random
        """Put robots at their starts."""
        return GridSteps(fleet_state(scenes, margin))


class GridSteps(Steps):
    """Points on grids."""

    def __init__(self, state: FleetState) -> None:
        self.state = state
        self.moving = np.zeros(state.place.shape, bool)

    def step(self, actions: Int) -> None:
        """Move all robots."""
        state = self.state
        to = soft(state, state.wishes(actions))
        self.interventions += state.refused
        state.remember(actions)
        state.move(to)
