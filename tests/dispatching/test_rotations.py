"""Robots that execute rotations do not touch."""

import attrs
import numpy as np
import pytest
from mrpbench_navigators_waypoints.rotations import LEAD, OFFSET
from mrpbench_tests.execution.rings import ring_problem, rotate

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.simulators.kinematic import Kinematic

CELL = 0.4
"""metres, the default of grids: about the smallest cells on which `group_margin` lets a turtlebot3_burger rotate."""


@attrs.frozen(kw_only=True)
class _OutOfStep(Adg):
    """Releases the same, and does not ask for robots to stay in step."""

    def start(self, problem, plan):
        session = super().start(problem, plan)
        update = session.update
        session.update = lambda now, view: attrs.evolve(update(now, view), in_step=())
        return session


@pytest.mark.parametrize("columns", [2, 3])
@pytest.mark.parametrize("controller", ["pure_pursuit.PurePursuit", "dwb.Dwb"])
def test_robots_that_rotate_in_step_keep_their_distance(controller, columns):
    package, name = controller.split(".")
    chosen = getattr(pytest.importorskip(f"mrpbench_controllers_{package}"), name)()
    found = rotate(Adg(), chosen, Kinematic(), cell=CELL, rings=2, turns=3, columns=columns)
    assert (found.rotations, found.contacts) == (6, 0)
    _, problem, _ = ring_problem(CELL, 1, 1, 0)
    exactly_in_step = CELL / np.sqrt(2) - 2 * problem.radius[0]
    assert found.gap > exactly_in_step - (LEAD + 2 * OFFSET) / np.sqrt(2) > 0


def test_robots_that_rotate_out_of_step_come_closer():
    controllers = pytest.importorskip("mrpbench_controllers_pure_pursuit")
    found, without = (
        rotate(dispatcher(), controllers.PurePursuit(), Kinematic(), cell=0.62, rings=2, turns=3)
        for dispatcher in (Adg, _OutOfStep)
    )
    assert found.gap > 0.16 > 0.1 > without.gap


def test_the_default_margin_is_what_the_navigator_keeps():
    assert Adg().group_margin >= (LEAD + 2 * OFFSET) / np.sqrt(2)


def test_cells_that_are_too_small_to_rotate_on_are_refused_by_name():
    _, problem, plan = ring_problem(0.39, 1, 1, 0)
    with pytest.raises(DispatchError, match=r"robots 0, 1, 2, 3 at vertices 0, 1, 2, 3 rotate.*use larger cells"):
        Adg().start(problem, plan)
