"""What becomes of the actions that robots choose: no two robots may share a cell or change places."""

from collections.abc import Callable, Iterator

import numpy as np

from mrpbench_core.api import Float, Int
from mrpbench_policies.fleet_state import FleetState, soft

Shield = Callable[[FleetState, Int, Float, Int], Int]
"""From the robots of one environment, their actions i8[n], scores f8[n,5] and priorities i8[n] to places i8[1,n]."""


def stop(state: FleetState, actions: Int, scores: Float, priority: Int) -> Int:  # noqa: ARG001 - of `pibt`
    """Let robots stay whose actions are illegal or conflict, see `soft`."""
    return soft(state, state.wishes(actions[None]))


def pibt(state: FleetState, actions: Int, scores: Float, priority: Int) -> Int:
    """Move robots by priority inheritance with backtracking, with the preferences of the policy.

    Okumura et al., "Priority Inheritance with Backtracking for Iterative Multi-agent Path Finding", AIJ 2022, where
    each robot tries its cells by their distance from its goal. Here the chosen action comes first, then the others by
    their scores: CS-PIBT of Veerapaneni et al., "Improving Learnt Local MAPF Policies with Heuristic Search", ICAPS
    2024. Robots with greater `priority` go first, then those of lower index.
    """
    place = state.place[0].tolist()
    preferred = scores.copy()
    preferred[np.arange(len(place)), actions] = np.inf
    order = np.argsort(-preferred, axis=1, kind="stable")
    cells = (state.place[0][:, None] + state.maps.offset[order]).tolist()
    blocked = state.maps.blocked
    occupant = {at: robot for robot, at in enumerate(place)}
    taken: dict[int, int] = {}
    to: list[int | None] = [None] * len(place)
    for first in np.argsort(-priority, kind="stable").tolist():
        if to[first] is not None:
            continue
        stack: list[tuple[int, int, Iterator[int]]] = [(first, -1, iter(cells[first]))]
        while stack:
            robot, pusher, left = stack[-1]
            pushed = None
            for cell in left:
                if cell in taken or blocked[cell] or (pusher >= 0 and cell == place[pusher]):
                    continue
                to[robot], taken[cell] = cell, robot
                other = occupant.get(cell, robot)
                if other != robot and to[other] is None:
                    pushed = other
                else:
                    stack = []  # all that push have their cells
                break
            else:  # no cell is left: it stays, and the robot that pushes it tries the next one
                to[robot], taken[place[robot]] = place[robot], robot
                stack.pop()
                continue
            if pushed is not None:
                stack.append((pushed, robot, iter(cells[pushed])))
    return np.array([to], np.int64)


SHIELDS: dict[str, Shield] = {"stop": stop, "pibt": pibt}
"""By name."""
