"""Rolls a policy out on a grid: asks it step by step, and moves the robots by a shield."""

import time
from collections.abc import Callable

import attrs
import numpy as np

from mrpbench_core.api import Int
from mrpbench_policies.acting import Acting
from mrpbench_policies.fleet_state import FleetState, in_rings
from mrpbench_policies.observations import Observation
from mrpbench_policies.shields import Shield

Memory = dict[str, np.ndarray]


@attrs.define(kw_only=True)
class Counts:
    """What the shield did."""

    illegal: int = 0
    """Actions that lead into a wall."""
    conflicting: int = 0
    """Other actions that the shield replaced."""


@attrs.define(kw_only=True, eq=False)
class Rollout:
    """Robots of one environment, the policy that acts for them, and what happened so far."""

    state: FleetState
    acting: Acting
    observation: Observation
    shield: Shield
    sampling: np.random.Generator | None
    """Draws actions, and their order for the shield, in proportion to the exponential of their scores; None: the best
    one is chosen. Adding Gumbel noise draws without replacement (Kool, van Hoof and Welling, ICML 2019)."""
    priority: Int
    """i8[n] steps since each robot was at its goal."""
    rings: bool = True
    """Robots may move in a ring, each to the cell of the next."""
    trace: list[Int] = attrs.field(factory=list)
    """Places i8[n] before each step, and after the last one."""
    memories: list[tuple[Memory, np.ndarray]] = attrs.field(factory=list)
    """What the policy remembered at each of them, and the last actions."""
    counts: Counts = attrs.field(factory=Counts)

    def run(self, steps: int, until: float, reached: Callable[[FleetState], bool]) -> bool | None:
        """Step until `reached` says so, at most so many `steps`; tell whether it did, None if `until` has passed.

        Args:
            steps: at most.
            until: seconds of `time.monotonic`.
            reached: called before each step; may give robots new goals.
        """
        for step in range(steps + 1):
            self._note()
            if reached(self.state):
                return True
            if time.monotonic() > until:
                return None
            if step < steps:
                self._step()
        return False

    def _note(self) -> None:
        self.trace.append(self.state.place[0].copy())
        self.memories.append((dict(self.acting.memory), self.state.chosen[0].copy()))

    def _step(self) -> None:
        state = self.state
        scores = self.acting.act(self.observation.observe(state))
        if self.sampling is not None:
            scores = scores + self.sampling.gumbel(size=scores.shape)
        actions = scores.argmax(axis=1)
        to = self.shield(state, actions, scores, self.priority)
        if not self.rings:
            to = np.where(in_rings(state, to), state.place, to)
        wish = state.wishes(actions)
        illegal = state.maps.blocked[wish]
        self.counts.illegal += int(illegal.sum())
        self.counts.conflicting += int(((wish != to) & ~illegal).sum())
        state.remember(actions[None])
        state.move(to)
        self.priority = np.where(state.on_goal[0], 0, self.priority + 1)
