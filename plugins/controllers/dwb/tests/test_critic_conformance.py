"""The suite of critics: those of Nav2 pass, and faults of others are named."""

from typing import ClassVar

import attrs
import numpy as np
import pytest
from mrpbench_controllers_dwb import Critic, CriticSession, PathDist
from mrpbench_tests.variant import variant

from mrpbench_core.testing import failed_checks, run_checks, suite_for

RANDOM = np.random.default_rng(0)


class Session(CriticSession):
    def __init__(self, scores):
        self.scores = scores

    def score(self, trajectories):
        return self.scores(trajectories)


@attrs.frozen(kw_only=True)
class Right(Critic):
    """Prefers the right-hand side."""

    how: ClassVar = staticmethod(lambda trajectories: np.maximum(trajectories.pose[:, -1, 1], 0.0))

    def start(self, robot, world):
        return Session(self.how)


@pytest.mark.parametrize("critic", [Right(), PathDist()], ids=["python", "native"])
def test_critics_that_keep_their_contract(critic):
    assert failed_checks(suite_for(critic)) == {}


def test_the_checks_are_those_of_the_kind():
    names = [check.name for check in run_checks(suite_for(PathDist()))]
    assert "its controller commands a robot with it" in names


def change(trajectories):
    trajectories.pose[:] = 0
    return np.zeros(len(trajectories.pose))


@pytest.mark.parametrize(
    ("how", "check", "reason"),
    [
        (lambda t: np.full(len(t.twist), np.nan), "scores each trajectory", "return infinity"),
        (lambda t: np.zeros((len(t.twist), 1)), "scores each trajectory", "return f8[1]"),
        (lambda t: None, "scores each trajectory", "return f8[1]"),
        (change, "does not change the trajectories", "copy it"),
        (lambda t: RANDOM.random(len(t.twist)), "the same trajectories have the same scores", "session"),
    ],
)
def test_a_critic_with_a_fault_is_told_what_to_change(how, check, reason):
    assert reason in failed_checks(suite_for(variant(Right, how=staticmethod(how))()))[check]
