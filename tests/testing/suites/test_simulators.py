"""The suites catch faults of simulators: each plugin here has one and fails its check."""

import attrs
import numpy as np
import pytest
from mrpbench_tests.variant import variant
from mrpbench_worlds_standard.shipped import Office

from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.testing import failed_checks, suite_for
from mrpbench_core.testing.fixtures.room import fleet


def simulator(**methods):
    """The kinematic simulator with other methods of its simulation."""

    def opened(self, *arguments, **named):
        inner = Kinematic().open(*arguments, **named)
        inner.__class__ = type("Changed", (type(inner),), methods)
        return inner

    return variant(Kinematic, open=opened)()


PLANE = type(Kinematic().open(Office().load(), fleet(1), np.ones((1, 3)), 0, 0.05))


def ghost(self, inputs):
    """Robots that pass through everything, at any speed."""
    twist = inputs.twist
    direction = np.column_stack([np.cos(self._pose[:, 2]), np.sin(self._pose[:, 2])])
    self._pose = self._pose + np.column_stack([direction * twist[:, :1], twist[:, 1]]) * self._period
    self._periods += 1
    self._scans += self._take_scans()
    self._state = attrs.evolve(self._state, pose=self._pose, twist=twist)
    return self._state


def mirrored(self, inputs):
    return PLANE.step(self, attrs.evolve(inputs, twist=inputs.twist * (1, -1)))


def drifting(self, inputs):
    self._pose = self._pose + (0, 0, 0.001)
    return PLANE.step(self, inputs)


def noisy(self, inputs):
    self._pose = self._pose + (1e-7 * np.random.default_rng().random(), 0, 0)
    return PLANE.step(self, inputs)


@pytest.mark.parametrize(
    ("methods", "checks"),
    [
        (
            {"step": ghost},
            {
                "no robot is faster than its limits",
                "walls stop robots and are reported",
                "robots do not pass through one another",
            },
        ),
        ({"step": mirrored}, {"a positive turn rate turns counter clockwise"}),
        ({"step": drifting}, {"a robot commanded straight moves straight", "robots without a command stay"}),
        ({"step": noisy}, {"runs are equal to the last bit"}),
        ({"scans": lambda self: self._scans}, {"scans come once and in order"}),
        ({"scans": lambda self: ()}, {"scans come once and in order", "scans measure walls and robots"}),
        (
            {
                "scans": lambda self: tuple(
                    attrs.evolve(scan, ranges=scan.ranges[:, ::-1]) for scan in PLANE.scans(self)
                )
            },
            {"scans measure walls and robots"},
        ),
        ({"close": lambda self: self.__dict__.pop("_pose")}, {"closes twice"}),
        (
            {"state": property(lambda self: attrs.evolve(self._state, pose=self._state.pose + 0.1))},
            {"begins with the placements", "states have the shapes of the contract"},
        ),
    ],
)
def test_a_simulator(methods, checks):
    assert checks <= failed_checks(suite_for(simulator(**methods))).keys()
