"""Metrics of plans and of their execution."""

from mrpbench_metrics_standard.execution import Execution
from mrpbench_metrics_standard.planning import Planning

__all__ = ["Execution", "Planning"]
