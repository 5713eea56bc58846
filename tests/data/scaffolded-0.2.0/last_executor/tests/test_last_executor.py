"""The contract of every executor; add tests for the behaviour of this one."""

from mrpbench_core.testing import ExecutorConformance

from mrpbench_executors_last_executor import LastExecutor


class TestLastExecutor(ExecutorConformance):
    def make(self) -> LastExecutor:
        return LastExecutor()
