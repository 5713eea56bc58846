"""Checks of the critics of `mppi`, for `mrpbench check` and tests: `class TestMine(MppiCriticConformance)`."""

from mrpbench_controllers_local import testing

from mrpbench_controllers_mppi.critic import MppiCritic
from mrpbench_controllers_mppi.mppi import Mppi
from mrpbench_controllers_mppi.nav2_critics import PredictedObstacleCritic


class MppiCriticConformance(testing.CriticConformance):
    """Checks of critics: `class TestMine(MppiCriticConformance)`."""

    def make(self) -> MppiCritic:
        """Return the critic to check."""
        raise NotImplementedError("define make(self) and return the critic to check")

    def controller(self) -> Mppi:
        """Return `mppi` with this critic alone."""
        critic = self.make()
        prediction = testing.NothingMoves() if isinstance(critic, PredictedObstacleCritic) else None
        return Mppi(critics=(critic,), prediction=prediction)
