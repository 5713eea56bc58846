"""The depth `timed`: robots turn before they move, and stop at random."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api import Int
from mrpbench_policies.env.commitments import next_cells
from mrpbench_policies.env.scenes import Scene
from mrpbench_policies.env.world_model import Depth, Steps, fleet_state
from mrpbench_policies.fleet_state import FleetState, soft

HEADINGS: Int = np.array([-1, 1, 3, 2, 0])
"""Quarter turns, counter-clockwise from the right, of each action; -1 = none."""


@attrs.frozen(kw_only=True)
class Timed(Depth):
    """Points on a grid with headings, all to the right at first. A quarter turn takes a step, and so does a move to the
    next cell, which begins when the robot faces it and its robot has left, or leaves in the same step.

    In each step a robot that does not stand still begins to do so with probability `delay`, for 1 to `longest` steps,
    all equally likely: then it neither turns nor moves.
    """

    delay: float = attrs.field(default=0.0, validator=[attrs.validators.ge(0), attrs.validators.lt(1)])
    longest: int = attrs.field(default=1, validator=attrs.validators.ge(1))

    def begin(self, scenes: Sequence[Scene], margin: int, seed: int) -> Steps:
        """Put robots at their starts."""
        return TimedSteps(self, fleet_state(scenes, margin), np.random.default_rng(seed))


class TimedSteps(Steps):
    """Points with headings on grids."""

    def __init__(self, options: Timed, state: FleetState, generator: np.random.Generator) -> None:
        shape = state.place.shape
        self.state, self._options, self._generator = state, options, generator
        self._action: Int = np.zeros(shape, np.int64)
        self._target: Int = np.full(shape, -1, np.int64)
        self._heading: Int = np.zeros(shape, np.int64)
        self._stopped: Int = np.zeros(shape, np.int64)
        self.moving = np.zeros(shape, bool)

    def lay(self, environment: int, scene: Scene) -> None:
        """Begin another scene in one environment."""
        super().lay(environment, scene)
        self._target[environment] = -1
        self._action[environment] = self._heading[environment] = self._stopped[environment] = 0

    def step(self, actions: Int) -> None:
        """Let robots choose, then turn or move."""
        state, options = self.state, self._options
        actions = np.where(self.moving, self._action, actions)
        to = next_cells(state, self._target, actions, rings=True)
        self.interventions += int(np.count_nonzero(state.active & ~self.moving & (state.wishes(actions) != to)))
        self._action = actions
        self._target = np.where(to == state.place, -1, to)
        state.remember(actions)
        if options.delay:
            self._stopped = np.maximum(self._stopped - 1, 0)
            begins = (self._generator.random(to.shape) < options.delay) & (self._stopped == 0)
            length = self._generator.integers(1, options.longest + 1, to.shape)
            self._stopped = np.where(begins, length, self._stopped)
        able = (self._target >= 0) & (self._stopped == 0) & state.active
        quarter = (HEADINGS[self._action] - self._heading) % 4
        faces = quarter == 0
        turn = np.where(quarter == 3, -1, 1)
        self._heading = np.where(able & ~faces, (self._heading + turn) % 4, self._heading)
        moved = soft(state, np.where(able & faces, to, state.place))
        arrived = moved == self._target
        state.move(moved)
        self._target = np.where(arrived, -1, self._target)
        self.moving = self._target >= 0
