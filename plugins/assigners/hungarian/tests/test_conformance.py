"""`hungarian` passes the checks of every assigner."""

from mrpbench_assigners_hungarian import Hungarian

from mrpbench_core.testing.suites.assigner import AssignerConformance


class TestBottleneck(AssignerConformance):
    def make(self):
        return Hungarian(objective="bottleneck")
