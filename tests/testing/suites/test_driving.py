"""The suites catch faults of localizers, navigators and crowds: each plugin here has one and fails its check."""

import attrs
import numpy as np

from mrpbench_core.api import (
    Crowd,
)
from mrpbench_core.builtin.localizers.ground_truth import GroundTruth
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.testing import failed_checks, suite_for
from mrpbench_core.testing.variant import variant


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
        radii = (0.3,)

        def __init__(self, speed):
            self.speed, self.x = speed, 0.0

        def step(self, dt, state):
            self.x += dt
            return np.array([(self.x, 0.0, self.speed, 0.0)])

    def crowd(speed):
        return variant(Crowd, start=lambda self, world, seed: Walk(speed))()

    assert not failed_checks(suite_for(crowd(1.0)))
    assert set(failed_checks(suite_for(crowd(3.0)))) == {"speeds are those of the motion"}
