"""The contract of every metric; add tests for the behaviour of this one."""

from mrpbench_core.testing import MetricConformance

from mrpbench_metrics_last_metric import LastMetric


class TestLastMetric(MetricConformance):
    def make(self) -> LastMetric:
        return LastMetric()
