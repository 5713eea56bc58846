"""The recovery `wait`: wait for others to leave."""

import attrs

from mrpbench_core.api import option
from mrpbench_core.api.recovery import Recovery, RecoverySession, Surroundings
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel


@attrs.frozen(kw_only=True)
class Wait(Recovery):
    """Stands still for a while."""

    wait_duration: float = option(5.0, help="time to wait", unit="s", validator=attrs.validators.ge(0))

    def start(self, robot: RobotModel, surroundings: Surroundings, period: float) -> RecoverySession:  # noqa: ARG002
        """Begin an attempt."""
        return _Session(self.wait_duration)


class _Session(RecoverySession):
    def __init__(self, duration: float) -> None:
        self._duration = duration
        self._until: float | None = None

    def step(self, now: float, pose: Float, twist: Float) -> tuple[float, float] | bool:  # noqa: ARG002
        if self._until is None:
            self._until = now + self._duration
        return (0.0, 0.0) if now < self._until else True
