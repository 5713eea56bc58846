"""Contract of the kind *critic*: what scores trajectories. Third parties write theirs in Python, in batches."""

from abc import ABC, abstractmethod
from typing import ClassVar

import attrs

from mrpbench_core.api import Component, option
from mrpbench_core.model.arrays import Float
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.world import World


@attrs.frozen(kw_only=True, eq=False)
class Trajectories:
    """What m velocity samples of one robot lead to."""

    twist: Float
    """f8[m,2] m/s, rad/s."""
    pose: Float
    """f8[m,p,3] x, y, yaw in `map`, one after the other; short trajectories stay at their last pose."""
    path: Float
    """f8[k,2] what the robot is to follow."""
    yaw: float
    """To take at its end, NaN = any."""


class CriticSession(ABC):
    """Scores the trajectories of one robot."""

    @abstractmethod
    def score(self, trajectories: Trajectories) -> Float:
        """Return f8[m], lower is better; infinity = must not be driven."""


@attrs.frozen(kw_only=True)
class Critic(Component):
    """Scores trajectories; DWB adds up the scores of all critics, each times its scale."""

    group: ClassVar[str] = "mrpbench.critics"

    scale: float = option(1.0, help="weight among the other critics; 0 = off", validator=attrs.validators.ge(0))

    @abstractmethod
    def start(self, robot: RobotModel, world: World) -> CriticSession:
        """Begin to score for one robot."""
