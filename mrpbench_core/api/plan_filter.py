"""Contract of the kind *plan filter* (provisional)."""

from abc import abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.arrays import Bool, Float


class PlanFilter(Component):
    """Thins out the waypoints of a plan before robots are sent along it.

    A robot then drives straight from each waypoint that is kept to the next. What was planned to be free of conflicts
    no longer need be.
    """

    group: ClassVar[str] = "mrpbench.plan_filters"

    @abstractmethod
    def keep(self, waypoint: Float) -> Bool:
        """Tell which waypoints f8[k,2] (metres, the start first) one robot keeps: bool[k], the first and last true."""
