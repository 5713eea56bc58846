"""Checks of the critics of `mppi`, for `mrpbench check` and tests: `class TestMine(MppiCriticConformance)`."""

from mrpbench_controllers_local import testing

from mrpbench_controllers_mppi.critic import MppiCritic
from mrpbench_controllers_mppi.mppi import Mppi


class MppiCriticConformance(testing.CriticConformance):
    """Checks of critics: `class TestMine(MppiCriticConformance)`."""

    def make(self) -> MppiCritic:
        """Return the critic to check."""
        raise NotImplementedError("define make(self) and return the critic to check")

    def controller(self) -> Mppi:
        """Return `mppi` with this critic alone."""
        return Mppi(critics=(self.make(),))
