"""Resolves the actions of robots of which some are between two cells."""

import numpy as np

from mrpbench_core.api import Int
from mrpbench_policies.fleet_state import FleetState, in_rings, soft


def next_cells(state: FleetState, target: Int, actions: Int, rings: bool) -> Int:
    """Return the places i8[b,n] to which robots are on their way, their own where they stay.

    A robot that is between two cells has its own and the next one, `target` i8[b,n], to itself; -1 = the robot is not.
    It leaves the first, so that another one may be on its way there. Apart from that conflicts are resolved by the rule
    `soft`, so that every robot can go on as soon as the one before it has left, and no robot waits forever.

    Args:
        state: where the robots are.
        target: where robots are on their way to.
        actions: i8[b,n], of the others.
        rings: robots may move in a ring, each to the cell of the next.
    """
    moving = target >= 0
    reserved = np.zeros(len(state.maps.blocked), bool)
    reserved[target[moving]] = True
    wish = state.wishes(np.where(moving, 0, actions))
    wish = np.where(reserved[wish], state.place, wish)
    wish = np.where(moving, target, wish)
    to = soft(state, wish)
    if not rings and (turning := in_rings(state, to)).any():
        to = soft(state, np.where(turning & ~moving, state.place, wish))
    return to
