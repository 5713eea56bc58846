"""Contract of the kind *plan filter* (provisional)."""

from abc import abstractmethod
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Bool, Float


class PlanFilter(Component):
    """Removes waypoints from a plan before robots drive along it.

    Robots drive straight from each remaining waypoint to the next, so the result may have conflicts that the plan does
    not have.
    """

    group: ClassVar[str] = "mrpbench.plan_filters"

    @abstractmethod
    def keep(self, waypoint: Float) -> Bool:
        """Tell bool[k] which waypoints f8[k,2] (metres, the start first) of one robot remain; first and last must."""
