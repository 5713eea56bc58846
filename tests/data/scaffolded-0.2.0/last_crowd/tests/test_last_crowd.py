"""The contract of every crowd; add tests for the behaviour of this one."""

from mrpbench_core.testing import CrowdConformance

from mrpbench_crowds_last_crowd import LastCrowd


class TestLastCrowd(CrowdConformance):
    def make(self) -> LastCrowd:
        return LastCrowd()
