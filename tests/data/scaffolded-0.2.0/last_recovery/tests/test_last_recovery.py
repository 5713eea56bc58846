"""The contract of every recovery; add tests for the behaviour of this one."""

from mrpbench_core.testing import RecoveryConformance

from mrpbench_recoveries_last_recovery import LastRecovery


class TestLastRecovery(RecoveryConformance):
    def make(self) -> LastRecovery:
        return LastRecovery()
