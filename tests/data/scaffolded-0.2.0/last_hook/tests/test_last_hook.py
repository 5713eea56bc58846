"""The contract of every hook; add tests for the behaviour of this one."""

from mrpbench_core.testing import HookConformance

from mrpbench_hooks_last_hook import hooks


class TestLastHook(HookConformance):
    def make(self) -> object:
        return hooks
