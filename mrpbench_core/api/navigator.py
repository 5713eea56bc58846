"""Contract of the kind *navigator* (provisional)."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mrpbench_core.api.component import Component
from mrpbench_core.api.controller import Controller
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.observation import FleetObservation
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.worlds.world import World


class NavigatorSession(ABC):
    """Drives a fleet."""

    @abstractmethod
    def adopt(self, routes: Sequence[Route], cut: Int32 | None = None) -> None:
        """Follow new routes, one per robot; each begins with the released part of the old one, index by index.

        The first `cut` i4[n] segments, which were driven long ago, are left out; None = nothing is. All counts of
        segments are less by that from now on, but never below 0.
        """

    @abstractmethod
    def step(self, now: float, observation: FleetObservation, orders: Orders) -> Motion:
        """Return twists for one control period, and how far each robot is; `now` in simulated seconds.

        A robot has arrived when it has reached its last waypoint and its mode is `WAITING`. While it turns to the yaw
        that is prescribed there, its mode is `FOLLOWING`.
        """


class Navigator(Component):
    """Drives robots along their released segments, by checkers, recoveries and a controller."""

    group: ClassVar[str] = "mrpbench.navigators"

    @abstractmethod
    def start(
        self, fleet: Fleet, world: World, routes: Sequence[Route], controller: Controller, period: float, seed: int
    ) -> NavigatorSession:
        """Begin at the start of `routes`; `period` is the control period in simulated seconds."""
