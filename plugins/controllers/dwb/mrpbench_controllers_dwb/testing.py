"""Checks of the critics of `dwb`, for `mrpbench check` and tests: `class TestMine(CriticConformance)`."""

from mrpbench_controllers_local import testing

from mrpbench_controllers_dwb.critic import Critic
from mrpbench_controllers_dwb.dwb import Dwb


class CriticConformance(testing.CriticConformance):
    """Checks of critics: `class TestMine(CriticConformance)`."""

    def make(self) -> Critic:
        """Return the critic to check."""
        raise NotImplementedError("define make(self) and return the critic to check")

    def controller(self) -> Dwb:
        """Return `dwb` with this critic alone."""
        return Dwb(critics=(self.make(),))
