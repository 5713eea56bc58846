"""Contract of the kind *assigner*."""

from abc import abstractmethod
from typing import ClassVar, Literal

import attrs

from mrpbench_core.api.component import Component, option
from mrpbench_core.model.planning.assignment import Assignment, AssignmentProblem

Cost = Literal["euclidean", "manhattan", "roadmap"]


@attrs.frozen(kw_only=True)
class Assigner(Component):
    """Decides which robot does which task."""

    group: ClassVar[str] = "mrpbench.assigners"
    reads_costs: ClassVar[bool] = True
    """False if the assigner ignores the cost matrix, which is then not computed."""
    optimal: ClassVar[bool] = False
    """True if it promises the least value of its objective, the sum of costs or what its option `objective` says."""

    cost: Cost = option(
        "euclidean",
        help="cost of a pair: straight-line or Manhattan distance (m), or duration of the shortest path (s)",
    )

    def idle_options(self) -> dict[str, str]:
        """Return `cost` if the assigner ignores costs."""
        return {} if self.reads_costs else {"cost": "this assigner reads no costs"}

    @abstractmethod
    def assign(self, problem: AssignmentProblem) -> Assignment:
        """Return an assignment of min(n, m) tasks, no pair of which has a forbidden (infinite) cost.

        Raises:
            AssignmentError: there is none, or the assigner found none.
        """


class AssignmentError(Exception):
    """No feasible assignment exists, or the solver did not find one."""
