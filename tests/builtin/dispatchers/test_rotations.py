"""Robots that execute rotations do not touch."""

import attrs
import pytest

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.testing.execution.rings import ring_problem, rotate

CELL = 0.62
"""metres: about the smallest cells on which a `group_margin` of 0.18 m lets a turtlebot3_burger rotate."""


@attrs.frozen(kw_only=True)
class _OutOfStep(Adg):
    """Releases the same, and does not ask for robots to stay in step."""

    def start(self, problem, plan):
        session = super().start(problem, plan)
        update = session.update
        session.update = lambda now, view: attrs.evolve(update(now, view), in_step=())
        return session


def test_robots_that_rotate_in_step_keep_their_distance():
    controllers = pytest.importorskip("mrpbench_controllers_pure_pursuit")
    found, without = (
        rotate(dispatcher(), controllers.PurePursuit(), Kinematic(), cell=CELL, rings=2, turns=3)
        for dispatcher in (Adg, _OutOfStep)
    )
    assert (found.rotations, found.contacts) == (6, 0)
    assert found.gap > 0.1 > without.gap


def test_cells_that_are_too_small_to_rotate_on_are_refused_by_name():
    _, problem, plan = ring_problem(0.4, 1, 1, 0)
    with pytest.raises(DispatchError, match=r"robots 0, 1, 2, 3 at vertices 0, 1, 2, 3 rotate.*use larger cells"):
        Adg(group_margin=0.18).start(problem, plan)
