"""The contract of every task source; add tests for the behaviour of this one."""

from mrpbench_core.testing import TaskSourceConformance

from mrpbench_task_sources_last_task_source import LastTaskSource


class TestLastTaskSource(TaskSourceConformance):
    def make(self) -> LastTaskSource:
        return LastTaskSource()
