"""How far the engine believes that a simulator can move a robot in one control period."""

from types import SimpleNamespace

import pytest

from mrpbench_core.api import Mover
from mrpbench_core.engine.execution.loop import _reach
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.testing.fixtures.following import SPRINTER


@pytest.mark.parametrize(("radius", "least"), [((), 0.0), ((0.5,), 0.5 + SPRINTER.radius), ((0.2, 0.9), 0.9)])
def test_a_mover_that_begins_again_on_a_robot_may_push_it_out_of_its_disc(radius, least):
    movers = tuple(Mover(radius=each, kind="obstacle", leg_radius=0.0) for each in radius)
    reach = _reach(SimpleNamespace(period=0.05, movers=movers, fleet=Fleet(robots=(SPRINTER,))))
    drives = 0.05 * SPRINTER.max_speed
    assert reach >= least + drives
    if not movers:
        assert reach <= 2 * drives + 0.05
