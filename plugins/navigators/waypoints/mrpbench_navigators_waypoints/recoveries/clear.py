"""The recovery `clear`: clear the costmap, as Nav2 does."""

import attrs

from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
class Clear(Recovery):
    """Clears the controller's costmap, which takes no time."""

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:  # noqa: ARG002
        """Begin an attempt."""
        return _Session(surroundings)


class _Session(RecoverySession):
    def __init__(self, surroundings: Surroundings) -> None:
        self._surroundings = surroundings

    def step(self, now: float, pose: Float, twist: Float) -> bool:  # noqa: ARG002
        self._surroundings.clear()
        return True
