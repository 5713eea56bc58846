"""Critics score the trajectories that a controller samples. Each controller with critics has a kind of its own."""

from abc import ABC, abstractmethod
from typing import Any

import attrs

from mrpbench_core.api import Component
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True, eq=False)
class Trajectories:
    """The trajectories of m samples of one robot."""

    twist: Float
    """Velocities, m/s and rad/s: f8[m,2] of controllers that keep them along a trajectory (`dwb`), else f8[m,p,2]."""
    pose: Float
    """f8[m,p,3] x, y, yaw in `map`, in order of time; shorter trajectories repeat their last pose."""
    path: Float
    """f8[k,2] x, y in `map` of the path to follow."""
    yaw: float
    """Yaw to take at the end of the path, NaN = any."""


class CriticSession(ABC):
    """Scores the trajectories of one robot."""

    @abstractmethod
    def score(self, trajectories: Trajectories) -> Float:
        """Return scores f8[m]; lower is better, infinity = the trajectory must not be driven."""


class Critic(Component):
    """Scores trajectories; the controller sums the scores of all critics."""

    @property
    @abstractmethod
    def weight(self) -> float:
        """The factor of its scores; 0 = off."""

    @abstractmethod
    def start(self, robot: RobotModel, world: World) -> CriticSession:
        """Begin to score for one robot."""


class NativeCritic(Critic):
    """A critic that runs in C++."""

    def start(self, robot: RobotModel, world: World) -> CriticSession:  # noqa: ARG002
        """Raise TypeError: controllers pass these critics to the native part instead."""
        raise TypeError(f"{type(self).__name__} runs in C++")

    @property
    @abstractmethod
    def parameters(self) -> dict[str, Any]:
        """The options of the native part."""
