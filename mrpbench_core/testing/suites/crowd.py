"""Checks that every crowd must pass, in a room of 4 × 3 m with one TurtleBot3 Burger at rest."""

import numpy as np

from mrpbench_core.api.crowd import Crowd, CrowdSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.movers import CrowdView, Movers
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room
from mrpbench_core.testing.suites.component import ComponentConformance

STEPS = 200
NOBODY = Movers(pose=np.empty((0, 3)), velocity=np.empty((0, 2)), level=np.empty(0, np.int16))
INSIDE = 0.01
"""Metres by which a mover may be inside a wall, or inside the robot where it came to that by itself."""


class CrowdConformance(ComponentConformance):
    """Checks of crowds: `class TestMine(CrowdConformance)`."""

    def make(self) -> Crowd:
        """Return the crowd to check."""
        raise NotImplementedError("define make(self) and return the crowd to check")

    def start(self, seed: int = 0) -> CrowdSession:
        """The crowd in the room."""
        return self.make().start(room(), fleet(1), seed, self.seen())

    def seen(self) -> CrowdView:
        """The robot at rest, and no other crowd."""
        state = State(
            pose=np.array([(1.0, 1.0, 0.0)]),
            twist=np.zeros((1, 2)),
            level=np.zeros(1, np.int16),
            contacts=np.empty((0, 2), np.int32),
            facilities=Facilities(room()).initial_state(),
        )
        return CrowdView(state=state, others=NOBODY, radius=np.empty(0))

    def walk(self, session: CrowdSession) -> list[Movers]:
        """Where the movers are at first and after each of 200 control periods, around a robot at rest."""
        view = self.seen()
        return [session.movers, *(session.step(PERIOD, view) for _ in range(STEPS))]

    def places(self, seed: int) -> Float:
        """Movers f8[t,m,5]: x, y, yaw, vx, vy."""
        return np.array([np.hstack([movers.pose, movers.velocity]) for movers in self.walk(self.start(seed))])

    def test_movers_have_the_shapes_of_the_contract(self) -> None:
        session = self.start()
        wanted = len(session.members)
        require(all(member.radius > 0 for member in session.members), "a member has no radius")
        for movers in self.walk(session):
            sizes = len(movers.pose), len(movers.velocity), len(movers.level)
            require(sizes == (wanted,) * 3, f"{sizes} poses, velocities and levels of {wanted} members")
            require(np.isfinite(movers.pose).all(), "a mover has a pose that is not finite")
            require(np.isfinite(movers.velocity).all(), "a mover has a velocity that is not finite")
            require(set(movers.level.tolist()) <= {-1, 0}, "a mover is on a level that the world does not have")

    def test_movers_are_where_the_last_step_put_them(self) -> None:
        session = self.start()
        last = self.walk(session)[-1]
        require(np.array_equal(last.pose, session.movers.pose), "`movers` is not what the last step returned")

    def test_the_same_seed_moves_them_the_same_way(self) -> None:
        require(np.array_equal(self.places(1), self.places(1)), "the same seed moves them differently the second time")

    def test_sessions_do_not_disturb_one_another(self) -> None:
        alone, other = self.places(1), self.start(2)
        together = self.start(1)
        self.walk(other)
        beside = np.array([np.hstack([movers.pose, movers.velocity]) for movers in self.walk(together)])
        require(np.array_equal(alone, beside), "a second session changes the first: keep no global state")

    def test_speeds_are_those_of_the_motion(self) -> None:
        walk = self.places(0)
        moved, said = np.diff(walk[..., :2], axis=0) / PERIOD, walk[1:, :, 3:]
        off = float(np.abs(moved - said).max(initial=0.0))
        require(off < 0.5, f"the velocity of a mover differs by {off:.2f} m/s from its motion")

    def test_movers_keep_out_of_walls(self) -> None:
        session, wall = self.start(), segments(room())
        radius = np.array([member.radius for member in session.members])
        for movers in self.walk(session):
            gap = point_segment_distance(movers.pose[:, None, :2], wall[:, :2], wall[:, 2:]).min(axis=1)
            deep = float((radius - gap)[movers.level == 0].max(initial=-np.inf))
            require(deep <= INSIDE, f"a mover is {deep:.3f} m inside a wall")
