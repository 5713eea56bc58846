"""Environments in the parallel form of PettingZoo: robots are agents, which act all at once."""

from collections.abc import Callable, Iterable, Mapping
from itertools import repeat
from pathlib import Path
from typing import Any, Literal

import numpy as np
from gymnasium import spaces
from pettingzoo import ParallelEnv

from mrpbench_core.api import InputError
from mrpbench_policies.env.episode import Episodes, Task
from mrpbench_policies.env.full_stack import FullStack
from mrpbench_policies.env.scenes import Scenes, StudyScenes
from mrpbench_policies.env.spaces import seed_of, space_of, split
from mrpbench_policies.env.timed import Timed
from mrpbench_policies.env.world_model import Depth, Grid, Steps
from mrpbench_policies.observations import Observation, PogemaDefault

MASKS = [(sum_of_bits >> np.arange(5) & 1).astype(np.int8) for sum_of_bits in range(32)]
"""i1[5]: whether each action has an effect, for the sums that `FleetState.free_actions` returns."""
for _mask in MASKS:
    _mask.setflags(write=False)


class FleetParallelEnv(ParallelEnv[str, Any, int]):  # type: ignore[misc] # PettingZoo has no types
    """Robots `robot_0`, `robot_1`, … that go to their goals.

    Actions are 0 stay, 1 up, 2 down, 3 left, 4 right. `infos[agent]["action_mask"]` i1[5], which cannot be written,
    says which have an effect: a robot that is between two cells goes on, whatever its action. At the end of an episode
    `infos[agent]["metrics"]` has the metrics of POGEMA. Rewards and ends are those of `Task`.

    Args:
        scenes: where episodes take place; `reset(seed=s)` begins that of seed s, and without a seed the next one.
        depth: how robots move.
        task: what they have to do.
        observation: what they perceive.
        render_mode: `ansi`: `render()` returns the map as text.
    """

    metadata: dict[str, Any] = {"name": "mrpbench_fleet_v0", "render_modes": ["ansi"], "is_parallelizable": True}  # noqa: RUF012 - PettingZoo's

    def __init__(
        self,
        scenes: Scenes,
        depth: Depth | None = None,
        task: Task | None = None,
        observation: Observation | None = None,
        render_mode: Literal["ansi"] | None = None,
    ) -> None:
        self._scenes, self._depth, self._task = scenes, depth or Grid(), task or Task()
        self._observation = observation or PogemaDefault()
        self.render_mode = render_mode
        self.possible_agents = [f"robot_{robot}" for robot in range(scenes.robots)]
        self.agents: list[str] = []
        self.observation_spaces = {agent: space_of(self._observation, scenes.shape) for agent in self.possible_agents}
        self.action_spaces = {agent: spaces.Discrete(5) for agent in self.possible_agents}
        self._steps: Steps | None = None
        self._seed = -1
        self._no_reward: dict[str, float] = {}
        """A reward of 0 for each of `agents`."""
        self._none: dict[str, bool] = {}
        """False for each of `agents`."""

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Return the space of the observations of a robot, the same object each time."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Return the space of its actions."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[dict[str, Any], Any]:  # noqa: ARG002
        """Begin an episode; return observations and infos."""
        self.close()
        self._seed = self._seed + 1 if seed is None else seed_of(seed)
        scene = self._scenes.draw(self._seed)
        self._steps = self._depth.begin([scene], self._observation.radius, self._seed)
        self._episodes = Episodes(self._task, self._steps.state, [self._seed])
        self._begin_acting(list(self.possible_agents))
        return self._observations(), self._infos()

    def step(self, actions: Mapping[str, int]) -> tuple[Any, Any, Any, Any, Any]:
        """Let a step pass; return observations, rewards, terminations, truncations and infos of robots that acted."""
        if self._steps is None:
            raise RuntimeError("call `reset` before `step`")
        agents = self.possible_agents
        chosen = np.fromiter(map(actions.get, agents, repeat(0)), np.int64, len(agents))
        if chosen.view(np.uint64).max() > 4:  # numbers below 0 are large ones there
            raise ValueError("actions are 0 to 4")
        self._steps.step(chosen[None])
        rewards, terminated, truncated = self._episodes.after_step()
        acting = self.agents
        observations, infos = self._observations(), self._infos()
        late = bool(truncated[0])
        any_ends = late or np.count_nonzero(terminated) > 0
        gained = self._of_acting(rewards[0].tolist()) if np.count_nonzero(rewards) else self._no_reward.copy()
        ends = self._of_acting(terminated[0].tolist()) if any_ends else self._none.copy()
        cut = {agent: late and not end for agent, end in ends.items()} if any_ends else ends.copy()
        if late or (any_ends and all(ends.values())):
            measures = self._episodes.measures(0)
            for agent in acting:
                infos[agent]["metrics"] = measures
        if any_ends:
            self._begin_acting([] if late else [agent for agent in acting if not ends[agent]])
        return observations, gained, ends, cut, infos

    def state(self) -> np.ndarray:
        """Return f4[rows+2,columns+2,3]: obstacles, robots and goals of the whole map, with its ring."""
        assert self._steps is not None, "call `reset` first"
        fleet = self._steps.state
        maps = fleet.maps
        whole = np.zeros((len(maps.blocked), 3), np.float32)
        whole[:, 0] = maps.obstacles
        whole[fleet.place[fleet.active], 1] = 1.0
        whole[fleet.goal[fleet.active], 2] = 1.0
        ring = slice(maps.margin - 1, -maps.margin + 1 or None)
        return whole.reshape(maps.height, maps.width, 3)[ring, ring]

    def render(self) -> str | None:
        """Return the map as text: `#` blocked, `r` robots, `G` goals without one, `.` free."""
        if self.render_mode is None or self._steps is None:
            return None
        obstacles, robots, goals = np.moveaxis(self.state(), -1, 0)
        letters = np.where(obstacles > 0, "#", np.where(robots > 0, "r", np.where(goals > 0, "G", ".")))
        return "\n".join("".join(row) for row in letters)

    def close(self) -> None:
        """Close what the episode uses."""
        if self._steps is not None:
            self._steps.close()
            self._steps = None

    @property
    def steps(self) -> Steps:
        """The robots of the episode; with bodies, their poses."""
        assert self._steps is not None, "call `reset` first"
        return self._steps

    def _observations(self) -> dict[str, Any]:
        assert self._steps is not None
        return self._of_acting(split(self._observation.observe(self._steps.state)))

    def _infos(self) -> dict[str, dict[str, Any]]:
        assert self._steps is not None
        bits = self._steps.state.free_actions(self._steps.moving)[0].tolist()
        if len(self.agents) < len(bits):
            bits = self._of_acting(bits).values()
        return {agent: {"action_mask": MASKS[some]} for agent, some in zip(self.agents, bits, strict=True)}

    def _of_acting(self, values: Iterable[Any]) -> dict[str, Any]:
        """The values of the robots that act, of those of all robots."""
        values_of = dict(zip(self.possible_agents, values, strict=True))
        if len(self.agents) == len(values_of):
            return values_of
        return {agent: values_of[agent] for agent in self.agents}

    def _begin_acting(self, agents: list[str]) -> None:
        """Let no other robots act."""
        self.agents = agents
        self._no_reward, self._none = dict.fromkeys(agents, 0.0), dict.fromkeys(agents, False)


def parallel_env(
    study: Path | str | dict[str, Any],
    depth: Literal["grid", "timed", "full_stack"] | Depth = "grid",
    task: Task | None = None,
    observation: Observation | None = None,
    render_mode: Literal["ansi"] | None = None,
    **overrides: Any,
) -> FleetParallelEnv:
    """Return the environment of a study: the instances of its first run, with any seed.

    Args:
        study: a file, or its content.
        depth: how robots move.
        task: what they have to do.
        observation: what they perceive, e.g. `CostToGo(4)`.
        render_mode: as in `FleetParallelEnv`.
        overrides: settings of the study, e.g. `scenario={"plugin": "random", "robots": 8}`.

    Raises:
        InputError: see `StudyScenes`.
    """
    scenes = StudyScenes(study, [f"{name}={value}" for name, value in overrides.items()])
    if isinstance(depth, Depth):
        return FleetParallelEnv(scenes, depth, task, observation, render_mode)
    depths: dict[str, Callable[[], Depth]] = {
        "grid": Grid,
        "timed": Timed,
        "full_stack": lambda: FullStack(config=scenes.config),
    }
    if depth not in depths:
        raise InputError(f"there is no depth {depth!r}", hint=f"known: {', '.join(depths)}")
    return FleetParallelEnv(scenes, depths[depth](), task, observation, render_mode)
