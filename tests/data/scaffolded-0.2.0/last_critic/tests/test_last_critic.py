"""The contract of every critic; add tests for the behaviour of this one."""

from mrpbench_controllers_dwb.testing import CriticConformance

from mrpbench_critics_last_critic import LastCritic


class TestLastCritic(CriticConformance):
    def make(self) -> LastCritic:
        return LastCritic()
