"""Contract of the kind *dispatcher*."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Int, Int32
from mrpbench_core.model.execution.orders import BatchOrders, FleetView, Orders
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem


class DispatcherSession(ABC):
    """Releases one plan."""

    @abstractmethod
    def update(self, now: float, view: FleetView) -> Orders:
        """Return how far along its path each robot may go. Called every control period; `now` in simulated seconds."""

    @abstractmethod
    def adopt(self, problem: Problem, plan: Plan, cut: Int32 | None = None) -> None:
        """Continue with a new plan that begins with the released part of the old one (`problem.commitments`).

        The first `cut` i4[n] segments of each path, which were driven long ago, are left out; None = nothing is. All
        counts of segments are less by that from now on, but never below 0; apart from that segments keep their indices.

        Raises:
            DispatchError: the new plan cannot be released safely from here. The session continues with the old one.
        """

    def waits_for(self, robot: int) -> Sequence[int] | None:  # noqa: ARG002 - for those that know
        """Return the robots that have to pass before the next move of `robot` is released, as far as the session knows;
        None = those that pass before it in the plan.

        Called where an execution ends before all robots have arrived, to explain why.
        """
        return None

    def close(self) -> None:  # noqa: B027 - most have nothing to leave
        """Leave whatever is outside of this process: the execution is over. Called once, also after an error.

        Only with physics.
        """

    def copied(self) -> "DispatcherSession | None":
        """Return a session that goes on from here as this one does, neither of them disturbing the other; None = it
        cannot.

        Many executions of one plan begin with copies, where that takes less time than to start anew. A copy may share
        what never changes.
        """
        return None

    def batch(self, executions: int) -> "BatchSession | None":  # noqa: ARG002 - for those that can
        """Return a session that goes on from here, as copies would, in so many executions at once; None = it cannot, or
        the plan needs doors, lifts or mutexes, or limits of speed.
        """
        return None


class BatchSession(ABC):
    """Releases one plan in d executions, all of which go on by the same clock."""

    @abstractmethod
    def update(self, now: float, progress: Int) -> BatchOrders:
        """Return for each execution what `DispatcherSession.update` would return.

        Called every control period.

        Args:
            now: simulated seconds.
            progress: i8[2,d,n] number of leading segments that each robot has reached, and has cleared; see
                `FleetView`.
        """


class Dispatcher(Component):
    """Decides how far along its path each robot may go now."""

    group: ClassVar[str] = "mrpbench.dispatchers"

    @abstractmethod
    def start(self, problem: Problem, plan: Plan) -> DispatcherSession:
        """Begin to release `plan`.

        Raises:
            DispatchError: the plan cannot be released safely; the message names the robots and vertices.
        """


class DispatchError(Exception):
    """A dispatcher cannot release a plan safely: the plan has conflicts, or a cycle that footprints do not allow."""
