"""What stands on blocked places: discs among the movers, which robots touch and lidars see."""

from collections.abc import Sequence

import numpy as np

from mrpbench_core.api.crowd import CrowdSession
from mrpbench_core.engine.execution.faults import FaultEvent
from mrpbench_core.model.common.arrays import Float, Int16
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import CrowdView, Mover, Movers


class Blockages(CrowdSession):
    """Puts a disc on each blocked place when its fault begins, or as soon as no robot or mover is there any more."""

    def __init__(self, events: Sequence[FaultEvent], fleet: Fleet) -> None:
        self._events, self._reach = tuple(events), fleet.radii
        self._now = 0.0
        self.members = tuple(Mover(radius=event.radius, kind="blockage") for event in self._events)
        place = np.reshape([(*event.place, 0.0) for event in self._events], (-1, 3))
        absent = np.full(len(self.members), -1, np.int16)
        self._movers = Movers(pose=place, velocity=np.zeros((len(self.members), 2)), level=absent)

    @property
    def movers(self) -> Movers:
        """The discs; one whose fault is not active is absent."""
        return self._movers

    def step(self, dt: float, view: CrowdView) -> Movers:
        """Go to the end of the control period."""
        self._now += dt
        level = self._movers.level.copy()
        for index, event in enumerate(self._events):
            if not event.begin <= self._now + 1e-9 < event.end:
                level[index] = -1
            elif level[index] < 0 and self._is_free(event, view):
                level[index] = event.level
        self._movers = Movers(pose=self._movers.pose, velocity=self._movers.velocity, level=level)
        return self._movers

    def _is_free(self, event: FaultEvent, view: CrowdView) -> bool:
        bodies = ((view.state, self._reach), (view.others, view.radius))
        return not any(_overlaps(event, one.pose, one.level, radius) for one, radius in bodies)


def _overlaps(event: FaultEvent, pose: Float, level: Int16, radius: Float) -> bool:
    near = np.hypot(*(pose[:, :2] - event.place).T) < radius + event.radius
    return bool((near & (level == event.level)).any())
