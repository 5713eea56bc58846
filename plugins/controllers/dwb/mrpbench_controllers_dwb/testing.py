"""Checks of the critics of `dwb`, for `mrpbench check` and tests: `class TestMine(CriticConformance)`."""

from mrpbench_controllers_local import testing

from mrpbench_controllers_dwb.critic import Critic
from mrpbench_controllers_dwb.dwb import Dwb
from mrpbench_controllers_dwb.nav2_critics import PredictedObstacle


class CriticConformance(testing.CriticConformance):
    """Checks of critics: `class TestMine(CriticConformance)`."""

    def make(self) -> Critic:
        """Return the critic to check."""
        raise NotImplementedError("define make(self) and return the critic to check")

    def controller(self) -> Dwb:
        """Return `dwb` with this critic alone."""
        critic = self.make()
        prediction = testing.NothingMoves() if isinstance(critic, PredictedObstacle) else None
        return Dwb(critics=(critic,), prediction=prediction)
