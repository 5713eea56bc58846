"""Contract of the critics of `mppi`. A critic of your own derives from `MppiCritic`."""

from typing import ClassVar

import attrs
from mrpbench_controllers_local import Critic

from mrpbench_core.api import option


@attrs.frozen(kw_only=True)
class MppiCritic(Critic):
    """Scores the trajectories that MPPI samples; MPPI sums the scores of all critics, each multiplied by its weight."""

    group: ClassVar[str] = "mrpbench.mppi_critics"
    suite: ClassVar[str | None] = "mrpbench_controllers_mppi.testing:MppiCriticConformance"

    cost_weight: float = option(1.0, help="weight among the other critics; 0 = off", validator=attrs.validators.ge(0))

    @property
    def weight(self) -> float:
        """The weight."""
        return self.cost_weight
