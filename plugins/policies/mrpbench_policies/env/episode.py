"""Episodes: goals, rewards and ends, as POGEMA has them."""

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api import Bool, Float, Int
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.pogema.measures import finishing, one_shot


@attrs.frozen(kw_only=True)
class Task:
    """What robots have to do, how they are rewarded, and when an episode ends.

    `nothing`: each robot goes to its goal and stays there. When all are there at once, each gets a reward of 1 and the
    episode terminates. `finish`: a robot that reaches its goal gets 1, terminates and leaves the grid. `restart`: it
    gets 1, and another goal in the same step, drawn among the cells that it can reach; no robot terminates. All other
    rewards are 0. After `steps` steps the episode is truncated.
    """

    on_target: Literal["nothing", "finish", "restart"] = attrs.field(
        default="nothing", validator=attrs.validators.in_(("nothing", "finish", "restart"))
    )
    steps: int = attrs.field(default=256, validator=attrs.validators.ge(1))


class Episodes:
    """Episodes in b environments, whose ends differ."""

    def __init__(self, task: Task, state: FleetState, seeds: Sequence[int]) -> None:
        self.task, self.state = task, state
        environments, robots = state.place.shape
        self.elapsed = np.zeros(environments, np.int64)
        self.reached = np.zeros((environments, robots), np.int64)
        self._history: list[Bool] = []
        self._generators = [np.random.default_rng([seed, 1]) for seed in seeds]

    def restart(self, environment: int, seed: int) -> None:
        """Note that another scene begins in one environment."""
        self.elapsed[environment], self.reached[environment] = 0, 0
        self._generators[environment] = np.random.default_rng([seed, 1])

    def after_step(self) -> tuple[Float, Bool, Bool]:
        """Return rewards f8[b,n], which robots terminated, bool[b,n], and which environments are truncated, bool[b]."""
        state, task = self.state, self.task
        on_goal = state.on_goal & state.active
        self.elapsed += 1
        truncated = self.elapsed >= task.steps
        if task.on_target == "nothing":
            done: Bool = np.asarray(on_goal.all(axis=1))
            self._remember(on_goal)
            terminated = np.broadcast_to(done[:, None], on_goal.shape)
            self.reached = on_goal.astype(np.int64)
            return terminated.astype(np.float64), terminated, truncated
        self.reached += on_goal
        if task.on_target == "finish":
            state.active &= ~on_goal
            self._remember(self.reached > 0)
            return on_goal.astype(np.float64), ~state.active, truncated
        environments, robots = on_goal.nonzero()
        for environment, robot in zip(environments.tolist(), robots.tolist(), strict=True):
            here = int(state.place[environment, robot])
            state.goal[environment, robot] = another(state.maps.component(here), here, self._generators[environment])
        return on_goal.astype(np.float64), np.zeros(on_goal.shape, bool), truncated

    def measures(self, environment: int) -> dict[str, float]:
        """Return the metrics of the episode that ended in an environment, by the definitions of POGEMA."""
        if self.task.on_target == "restart":
            return {"avg_throughput": float(self.reached[environment].sum() / self.task.steps)}
        length = int(self.elapsed[environment])
        on_goal = np.stack([step[environment] for step in self._history[-length:]])
        return one_shot(on_goal) if self.task.on_target == "nothing" else finishing(on_goal)

    def _remember(self, on_goal: Bool) -> None:
        self._history.append(on_goal)
        if len(self._history) > 2 * self.task.steps:
            del self._history[: self.task.steps]


def another(cells: Int, here: int, generator: np.random.Generator) -> int:
    """Draw one of the places i8[k], which increase, other than `here`, which is the answer if it is the only one."""
    if len(cells) == 1:
        return here
    number = int(generator.integers(len(cells) - 1))
    return int(cells[number + (number >= np.searchsorted(cells, here))])
