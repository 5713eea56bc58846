"""The suites catch faults of localizers, navigators and crowds: each plugin here has one and fails its check."""

import attrs
import numpy as np
from mrpbench_navigators_waypoints import Waypoints
from mrpbench_tests.variant import variant

from mrpbench_core.api import Crowd, Mover, Movers
from mrpbench_core.builtin.localizers.ground_truth import GroundTruth
from mrpbench_core.testing import failed_checks, suite_for


def test_a_localizer_that_is_lost():
    def start(self, *arguments):
        inner = GroundTruth().start(*arguments)
        inner.__class__ = type(
            "Lost",
            (type(inner),),
            {
                "update": lambda lost, now, *seen: attrs.evolve(
                    type(inner).__mro__[1].update(lost, now, *seen), pose=seen[2] + now
                )
            },
        )
        return inner

    assert "follows robots whose sensors are exact" in failed_checks(suite_for(variant(GroundTruth, start=start)()))


def test_a_navigator_that_stands_still():
    def start(self, *arguments):
        inner = Waypoints.start(self, *arguments)
        step = inner.step
        inner.step = lambda *seen: attrs.evolve(step(*seen), twist=np.zeros((2, 2)))
        return inner

    found = failed_checks(suite_for(variant(Waypoints, start=start)()))
    assert {"drives robots to the ends of their routes", "goes on with longer routes"} <= found.keys()


def test_a_crowd():
    class Walk:
        members = (Mover(radius=0.3),)

        def __init__(self, speed, x):
            self.speed, self.x = speed, x

        @property
        def movers(self):
            level = np.zeros(1, np.int16)
            return Movers(pose=np.array([(self.x, 2.0, 0.0)]), velocity=np.array([(self.speed, 0.0)]), level=level)

        def step(self, dt, seen):
            self.x += 0.1 * dt
            return self.movers

    def crowd(speed, x=2.0):
        return variant(Crowd, start=lambda self, world, fleet, seed, seen: Walk(speed, x))()

    assert not failed_checks(suite_for(crowd(0.1)))
    assert set(failed_checks(suite_for(crowd(3.0)))) == {"speeds are those of the motion"}
    assert set(failed_checks(suite_for(crowd(0.1, 3.5)))) == {"movers keep out of walls"}
