"""Metric last_metric for mrpbench."""

from mrpbench_metrics_last_metric.last_metric import LastMetric

__all__ = ["LastMetric"]
