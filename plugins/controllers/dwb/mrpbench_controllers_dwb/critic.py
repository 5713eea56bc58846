"""Contract of the kind *critic*, which scores trajectories. A critic of your own derives from `Critic`."""

from abc import ABC, abstractmethod
from typing import ClassVar

import attrs

from mrpbench_core.api import Component, option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True, eq=False)
class Trajectories:
    """The trajectories of m velocity samples of one robot."""

    twist: Float
    """f8[m,2] m/s, rad/s."""
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


@attrs.frozen(kw_only=True)
class Critic(Component):
    """Scores trajectories; DWB sums the scores of all critics, each multiplied by its scale."""

    group: ClassVar[str] = "mrpbench.critics"
    suite: ClassVar[str | None] = "mrpbench_controllers_dwb.testing:CriticConformance"

    scale: float = option(1.0, help="weight among the other critics; 0 = off", validator=attrs.validators.ge(0))

    @abstractmethod
    def start(self, robot: RobotModel, world: World) -> CriticSession:
        """Begin to score for one robot."""
