"""Environments in the forms of Gymnasium: a whole fleet as one, and many fleets as a batch."""

from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv

from mrpbench_policies.env.episode import Episodes, Task
from mrpbench_policies.env.scenes import Scenes
from mrpbench_policies.env.spaces import actions_of, joined, seed_of, space_of
from mrpbench_policies.env.world_model import Depth, Grid, Steps
from mrpbench_policies.observations import Observation, PogemaDefault


class FleetVectorEnv(VectorEnv[Any, Any, Any]):
    """Many fleets at once, each an environment of Gymnasium's vector form.

    Observations have the axes environment, robot, …; actions are i8[environments, robots]. An environment's reward
    is the mean of its robots', which `infos["rewards"]` f8[environments, robots] has. It terminates when all
    of its robots have. `infos["moving"]` says which robots go on whatever their action. At the end of an episode
    `infos["metrics"]` has the metrics of POGEMA, NaN for the other environments. An environment whose episode has ended
    begins the next one in the next step, whose actions it ignores (`AutoresetMode.NEXT_STEP`).

    Args:
        scenes: where episodes take place.
        num_envs: environments; environment i begins with the scene of seed `seed + i`, and goes on in strides.
        depth: how robots move.
        task: what they have to do.
        observation: what they perceive.
    """

    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        scenes: Scenes,
        num_envs: int,
        depth: Depth | None = None,
        task: Task | None = None,
        observation: Observation | None = None,
    ) -> None:
        self._scenes, self._depth, self._task = scenes, depth or Grid(), task or Task()
        if not self._depth.batched and num_envs > 1:
            raise ValueError(f"the depth {type(self._depth).__name__} has one environment; use `AsyncVectorEnv`")
        self._observation = observation or PogemaDefault()
        self.num_envs = num_envs
        robots = scenes.robots
        self.single_observation_space = space_of(self._observation, scenes.shape, robots)
        self.observation_space = space_of(self._observation, scenes.shape, num_envs, robots)
        self.single_action_space = spaces.MultiDiscrete([5] * robots)
        self.action_space = spaces.MultiDiscrete(np.full((num_envs, robots), 5))
        self._steps: Steps | None = None
        self._next_seed = 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:  # noqa: ARG002
        """Begin an episode in all environments."""
        self.close()
        if seed is not None:
            self._next_seed = seed_of(seed)
        self._seeds = list(range(self._next_seed, self._next_seed + self.num_envs))
        self._next_seed += self.num_envs
        scenes = [self._scenes.draw(seed) for seed in self._seeds]
        self._steps = self._depth.begin(scenes, self._observation.radius, self._seeds[0])
        self._episodes = Episodes(self._task, self._steps.state, self._seeds)
        self._ended = np.zeros(self.num_envs, bool)
        return self._observe(), {"moving": self._steps.moving.copy()}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Let a step pass in all environments."""
        assert self._steps is not None, "call `reset` before `step`"
        self._steps.step(actions_of(actions, self.num_envs, self._scenes.robots))
        rewards, terminated, truncated = self._episodes.after_step()
        again = self._ended
        for environment in np.flatnonzero(again).tolist():
            self._begin_again(environment)
        rewards = np.where(again[:, None], 0.0, rewards)
        done = terminated.all(axis=1) & ~again
        truncated = truncated & ~again & ~done
        self._ended = done | truncated
        infos: dict[str, Any] = {"rewards": rewards, "moving": self._steps.moving.copy()}
        if self._ended.any():
            infos["metrics"], infos["_metrics"] = self._measures(), self._ended.copy()
        return self._observe(), rewards.mean(axis=1), done, truncated, infos

    def close(self, **kwargs: Any) -> None:
        """Close what the episodes use."""
        del kwargs
        if self._steps is not None:
            self._steps.close()
            self._steps = None

    def _begin_again(self, environment: int) -> None:
        assert self._steps is not None
        seed = self._seeds[environment] = self._next_seed
        self._next_seed += 1
        scene = self._scenes.draw(seed)
        if self._depth.batched:
            self._steps.lay(environment, scene)
            self._episodes.restart(environment, seed)
        else:
            self._steps.close()
            self._steps = self._depth.begin([scene], self._observation.radius, seed)
            self._episodes = Episodes(self._task, self._steps.state, [seed])

    def _measures(self) -> dict[str, Any]:
        measures: dict[str, Any] = {}
        for environment in np.flatnonzero(self._ended).tolist():
            for name, value in self._episodes.measures(environment).items():
                measures.setdefault(name, np.full(self.num_envs, np.nan))[environment] = value
        return measures

    def _observe(self) -> Any:
        assert self._steps is not None
        arrays = self._observation.observe(self._steps.state)
        return joined(arrays, self.num_envs, self._scenes.robots)


class FleetEnv(gymnasium.Env[Any, Any]):
    """One fleet as one environment: observations have the axes robot, …; actions are i8[robots].

    The reward is the mean of the robots', which `info["rewards"]` has; everything else as in `FleetParallelEnv`.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        scenes: Scenes,
        depth: Depth | None = None,
        task: Task | None = None,
        observation: Observation | None = None,
        render_mode: Literal[None] = None,
    ) -> None:
        self.render_mode = render_mode
        self._scenes, self._depth, self._task = scenes, depth or Grid(), task or Task()
        self._observation = observation or PogemaDefault()
        self.observation_space = space_of(self._observation, scenes.shape, scenes.robots)
        self.action_space = spaces.MultiDiscrete([5] * scenes.robots)
        self._steps: Steps | None = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode: the scene of a seed, or one drawn by the generator of the environment."""
        super().reset(seed=seed, options=options)
        self.close()
        drawn = int(self.np_random.integers(2**31)) if seed is None else seed_of(seed)
        scene = self._scenes.draw(drawn)
        self._steps = self._depth.begin([scene], self._observation.radius, drawn)
        self._episodes = Episodes(self._task, self._steps.state, [drawn])
        return self._observe(), {"moving": self._steps.moving[0].copy()}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Let a step pass."""
        assert self._steps is not None, "call `reset` before `step`"
        self._steps.step(actions_of(action, self._scenes.robots)[None])
        rewards, terminated, truncated = self._episodes.after_step()
        info: dict[str, Any] = {"rewards": rewards[0], "moving": self._steps.moving[0].copy()}
        done = bool(terminated.all())
        cut = bool(truncated[0]) and not done
        if done or cut:
            info["metrics"] = self._episodes.measures(0)
        return self._observe(), float(rewards.mean()), done, cut, info

    def close(self) -> None:
        """Close what the episode uses."""
        if self._steps is not None:
            self._steps.close()
            self._steps = None

    def _observe(self) -> Any:
        assert self._steps is not None
        return joined(self._observation.observe(self._steps.state), self._scenes.robots)
