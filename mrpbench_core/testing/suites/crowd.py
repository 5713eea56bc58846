"""Checks that every crowd must pass."""

import numpy as np

from mrpbench_core.api.crowd import Crowd
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.state import State
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.room import PERIOD, room
from mrpbench_core.testing.suites.component import ComponentConformance


class CrowdConformance(ComponentConformance):
    """Checks of crowds: `class TestMine(CrowdConformance)`."""

    def make(self) -> Crowd:
        """Return the crowd to check."""
        raise NotImplementedError("define make(self) and return the crowd to check")

    def walk(self, seed: int) -> Float:
        """Movers f8[t,m,4] around a robot at rest."""
        session = self.make().start(room(), seed)
        state = State(
            pose=np.array([(1.0, 1.0, 0.0)]),
            twist=np.zeros((1, 2)),
            level=np.zeros(1, np.int16),
            contacts=np.empty((0, 2), np.int32),
        )
        steps = [np.array(session.step(PERIOD, state), float) for _ in range(100)]
        shapes, wanted = {step.shape for step in steps}, (len(session.radii), 4)
        require(shapes == {wanted}, f"movers have shapes {shapes} instead of {wanted}")
        require(all(radius > 0 for radius in session.radii), f"radii are {session.radii}")
        return np.array(steps)

    def test_movers_have_places_and_speeds(self) -> None:
        require(np.isfinite(self.walk(0)).all(), "a mover has a position or velocity that is not finite")

    def test_the_same_seed_moves_them_the_same_way(self) -> None:
        require(np.array_equal(self.walk(1), self.walk(1)), "the same seed moves them differently the second time")

    def test_speeds_are_those_of_the_motion(self) -> None:
        walk = self.walk(0)
        moved, said = np.diff(walk[..., :2], axis=0) / PERIOD, walk[1:, :, 2:]
        off = float(np.abs(moved - said).max(initial=0.0))
        require(off < 0.5, f"the velocity of a mover differs by {off:.2f} m/s from its motion")
