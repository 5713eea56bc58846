"""The contract of every assigner; add tests for the behaviour of this one."""

from mrpbench_core.testing import AssignerConformance

from mrpbench_assigners_last_assigner import LastAssigner


class TestLastAssigner(AssignerConformance):
    def make(self) -> LastAssigner:
        return LastAssigner()
