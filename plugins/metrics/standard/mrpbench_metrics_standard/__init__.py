"""Metrics of plans and of their execution."""

from mrpbench_metrics_standard.deadlock import Deadlock
from mrpbench_metrics_standard.delay import Delay
from mrpbench_metrics_standard.execution import Execution
from mrpbench_metrics_standard.fairness import Fairness
from mrpbench_metrics_standard.planning import Planning
from mrpbench_metrics_standard.throughput import Throughput

__all__ = ["Deadlock", "Delay", "Execution", "Fairness", "Planning", "Throughput"]
