"""The suite catches faults of recoveries: each plugin here has one and fails its check."""

import attrs
import numpy as np
import pytest
from mrpbench_tests.variant import variant

from mrpbench_core.api.recovery import Recovery, RecoverySession
from mrpbench_core.testing import failed_checks, suite_for


class Session(RecoverySession):
    def __init__(self, answers):
        self.answers = answers

    def step(self, now, pose, twist):
        return self.answers(now)


@attrs.frozen(kw_only=True)
class Stay(Recovery):
    """Stands for a second."""

    def start(self, robot, surroundings, period):
        return Session(lambda now: (0.0, 0.0) if now < 1 else True)


def answering(answers):
    return variant(Stay, start=lambda self, robot, surroundings, period: Session(answers))()


def test_a_recovery_that_keeps_its_contract():
    assert failed_checks(suite_for(Stay())) == {}


@pytest.mark.parametrize(
    ("answers", "check", "reason"),
    [
        (lambda now: (0.0, 0.0), "an attempt ends also if the robot cannot move", "return False after a time"),
        (lambda now: None, "an attempt ends also if the robot cannot move", "step returns None: return (speed"),
        (lambda now: (np.nan, 0.0), "an attempt ends also if the robot cannot move", "speeds must be finite"),
        (lambda now: (9.0, 0.0) if now < 1 else True, "commands are within the limits of the robot", "max_speed"),
        (lambda now: (0.1, 0.0) if now < 1 else True, "a robot with no free pose around it is not moved", "is_free"),
    ],
)
def test_a_recovery_with_a_fault_is_told_what_to_change(answers, check, reason):
    assert reason in failed_checks(suite_for(answering(answers)))[check]
