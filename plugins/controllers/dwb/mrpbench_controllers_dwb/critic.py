"""Contract of the kind *critic*: the critics of `dwb`. A critic of your own derives from `Critic`."""

from typing import ClassVar

import attrs
from mrpbench_controllers_local import Critic as AnyCritic
from mrpbench_controllers_local import CriticSession, Trajectories

from mrpbench_core.api import option

__all__ = ["Critic", "CriticSession", "Trajectories"]


@attrs.frozen(kw_only=True)
class Critic(AnyCritic):
    """Scores trajectories; DWB sums the scores of all critics, each multiplied by its scale."""

    group: ClassVar[str] = "mrpbench.critics"
    suite: ClassVar[str | None] = "mrpbench_controllers_dwb.testing:CriticConformance"

    scale: float = option(1.0, help="weight among the other critics; 0 = off", validator=attrs.validators.ge(0))

    @property
    def weight(self) -> float:
        """The scale."""
        return self.scale
