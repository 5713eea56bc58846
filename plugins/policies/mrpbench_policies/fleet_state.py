"""Where the robots of a batch of environments are, and how they move in one step."""

import attrs
import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api import Bool, Int
from mrpbench_policies.maps import Maps

MEMORY = 5
"""Steps whose choices are remembered."""


@attrs.define(kw_only=True, eq=False)
class FleetState:
    """The robots of b environments with n robots each; make it with `at`."""

    maps: Maps
    place: Int
    """i8[b,n]: see `Maps`."""
    goal: Int
    """i8[b,n] places."""
    start: Int
    """i8[b,n] places."""
    active: Bool
    """bool[b,n]: false for robots that have left the grid."""
    overwritten: Bool
    """bool[b,n]: the robot entered the cell of one with a higher index in the last step. POGEMA 1.4 moves robots one
    after another in its raster of robots, so that the second erases the first, until that one acts again."""
    refused: int = 0
    """Active robots that did not get their wish in the last call of `soft`."""
    chosen: NDArray[np.int8]
    """i1[b,n,5]: the last actions chosen, oldest first, -1 = none yet; what became of them is not regarded."""

    @classmethod
    def at(cls, maps: Maps, start: Int, goal: Int) -> "FleetState":
        """Return robots at `start` i8[b,n] with goals at `goal` i8[b,n], all places."""
        return cls(
            maps=maps,
            place=start.copy(),
            goal=goal.copy(),
            start=start.copy(),
            active=np.ones(start.shape, bool),
            overwritten=np.zeros(start.shape, bool),
            chosen=np.full((*start.shape, MEMORY), -1, np.int8),
        )

    @property
    def on_goal(self) -> Bool:
        """bool[b,n]: the robot is where its goal is."""
        there: Bool = self.place == self.goal
        return there

    def remember(self, actions: Int) -> None:
        """Note the actions i8[b,n] that were chosen."""
        self.chosen[..., :-1] = self.chosen[..., 1:]
        self.chosen[..., -1] = actions

    def wishes(self, actions: Int) -> Int:
        """Return the places i8[b,n] to which actions i8[b,n] would lead."""
        wish: Int = self.place + self.maps.offset[actions]
        return wish

    def free_actions(self, moving: Bool) -> NDArray[np.uint8]:
        """Return which actions lead to free cells, u1[b,n]: stay 1, up 2, down 4, left 8, right 16; of robots that are
        `moving` bool[b,n], stay only.
        """
        bits = np.empty(self.place.shape, np.uint8)
        self.maps.native.free_actions(self.place, bits)
        bits[moving] = 1
        return bits

    def move(self, to: Int) -> None:
        """Put the robots at places i8[b,n]."""
        self.overwritten = np.empty(to.shape, bool)
        self.maps.native.overwritten(self.active, self.place, to, self.overwritten)
        self.place = to


def soft(state: FleetState, wish: Int) -> Int:
    """Return where the robots are after a step, i8[b,n], if they want to be at places `wish` i8[b,n].

    Conflicts are resolved by the rule `soft` of POGEMA (Skrynnik et al., ICLR 2025): two robots that want to change
    places stay. Of several that want one cell the first gets it. Whoever would come to a wall, or to the cell of a
    robot that stays, stays as well. A robot may enter a cell in the step in which another leaves it, also in a ring. So
    no two robots share a cell or meet on an edge (`following: allowed`).
    """
    to = np.empty_like(wish)
    state.refused = state.maps.native.soft(state.active, state.place, wish, to)
    return to


def in_rings(state: FleetState, to: Int) -> Bool:
    """Tell which robots, bool[b,n], move in a ring or behind one."""
    active = state.active.ravel()
    occupant = np.full(len(state.maps.blocked), -1, np.int32)
    occupant[state.place.ravel()[active]] = np.flatnonzero(active)
    ahead = np.where(to == state.place, -1, occupant[to]).ravel()
    follows = np.append(ahead, -1)  # -1 leads to itself
    for _ in range(int(np.ceil(np.log2(len(follows))))):
        follows = follows[follows]
    in_ring: Bool = (follows[:-1] >= 0).reshape(to.shape)
    return in_ring
