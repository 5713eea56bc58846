"""The contract of every mppi critic; add tests for the behaviour of this one."""

from mrpbench_controllers_mppi.testing import MppiCriticConformance

from mrpbench_mppi_critics_last_mppi_critic import LastMppiCritic


class TestLastMppiCritic(MppiCriticConformance):
    def make(self) -> LastMppiCritic:
        return LastMppiCritic()
