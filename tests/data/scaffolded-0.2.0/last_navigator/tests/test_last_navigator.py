"""The contract of every navigator; add tests for the behaviour of this one."""

from mrpbench_core.testing import NavigatorConformance

from mrpbench_navigators_last_navigator import LastNavigator


class TestLastNavigator(NavigatorConformance):
    def make(self) -> LastNavigator:
        return LastNavigator()
