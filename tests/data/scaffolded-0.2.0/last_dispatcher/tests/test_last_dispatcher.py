"""The contract of every dispatcher; add tests for the behaviour of this one."""

from mrpbench_core.testing import DispatcherConformance

from mrpbench_dispatchers_last_dispatcher import LastDispatcher


class TestLastDispatcher(DispatcherConformance):
    def make(self) -> LastDispatcher:
        return LastDispatcher()
