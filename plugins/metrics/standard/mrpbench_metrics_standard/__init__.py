"""Metrics of plans and of their execution."""

from mrpbench_metrics_standard.barn import Barn
from mrpbench_metrics_standard.clearance import Clearance
from mrpbench_metrics_standard.contact import Contact
from mrpbench_metrics_standard.deadlock import Deadlock
from mrpbench_metrics_standard.delay import Delay
from mrpbench_metrics_standard.draws import Draws
from mrpbench_metrics_standard.efficiency import Efficiency
from mrpbench_metrics_standard.execution import Execution
from mrpbench_metrics_standard.fairness import Fairness
from mrpbench_metrics_standard.localization import Localization
from mrpbench_metrics_standard.people import People
from mrpbench_metrics_standard.planning import Planning
from mrpbench_metrics_standard.smoothness import Smoothness
from mrpbench_metrics_standard.stops import Stops
from mrpbench_metrics_standard.tasks import Tasks
from mrpbench_metrics_standard.throughput import Throughput
from mrpbench_metrics_standard.tracking import Tracking
from mrpbench_metrics_standard.waiting import Waiting

__all__ = [
    "Barn",
    "Clearance",
    "Contact",
    "Deadlock",
    "Delay",
    "Draws",
    "Efficiency",
    "Execution",
    "Fairness",
    "Localization",
    "People",
    "Planning",
    "Smoothness",
    "Stops",
    "Tasks",
    "Throughput",
    "Tracking",
    "Waiting",
]
