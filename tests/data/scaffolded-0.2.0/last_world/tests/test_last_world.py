"""The contract of every world; add tests for the behaviour of this one."""

from mrpbench_core.testing import WorldConformance

from mrpbench_worlds_last_world import LastWorld


class TestLastWorld(WorldConformance):
    def make(self) -> LastWorld:
        return LastWorld()
