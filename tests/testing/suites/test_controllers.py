"""The suites catch faults of controllers: each plugin here has one and fails its check."""

import numpy as np
import pytest
from mrpbench_tests.variant import variant

from mrpbench_core.api import (
    Controller,
    ControllerSession,
)
from mrpbench_core.testing import failed_checks, suite_for


def controller(command):
    made = type("Changed", (ControllerSession,), {"command": command})
    return variant(Controller, start=lambda self, robot, world, period: made())()


@pytest.mark.parametrize(
    ("command", "check"),
    [
        (lambda self, seen: (5.0, 0.0), "commands are within the limits of the robot"),
        (lambda self, seen: (float("nan"), 0.0), "commands are within the limits of the robot"),
        (lambda self, seen: (0.2, 0.0), "keeps the speed that is allowed"),
        (lambda self, seen: (0.0, 0.0), "comes to the end of a straight path and stops"),
        (lambda self, seen: (0.1, 0.0), "a robot at the end stays"),
        (lambda self, seen: (0.0, 0.5), "turns towards the path"),
        (lambda self, seen: (0.1, 0.0), "comes round a corner and stops"),
        (
            lambda self, seen: (np.random.default_rng().random() / 10, 0.0),
            "the same observations give the same commands",
        ),
    ],
)
def test_a_controller(command, check):
    assert check in failed_checks(suite_for(controller(command)))


def test_a_controller_with_memory_in_its_recipe():
    class Shared(ControllerSession):
        calls = 0

        def command(self, seen):
            Shared.calls += 1
            return (0.1 if Shared.calls % 3 else 0.0), 0.0

    found = failed_checks(suite_for(variant(Controller, start=lambda self, robot, world, period: Shared())()))
    assert "robots do not disturb one another" in found
