"""The contract of every simulator; add tests for the behaviour of this one."""

from mrpbench_core.testing import SimulatorConformance

from mrpbench_simulators_last_simulator import LastSimulator


class TestLastSimulator(SimulatorConformance):
    def make(self) -> LastSimulator:
        return LastSimulator()
