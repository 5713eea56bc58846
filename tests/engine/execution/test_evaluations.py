"""Controllers are asked what they weighed: of the robots and as often as asked, bounded, and without any effect."""

import numpy as np
import pytest

from mrpbench_core.api import Controller, ControllerSession, Evaluation
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.settings import RecordedTrajectories
from mrpbench_core.engine.execution.evaluations import POSES, SAMPLES, Evaluations
from mrpbench_core.engine.execution.observed_controller import observed
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.observation import Observations
from mrpbench_core.testing.fixtures.room import PERIOD, ROBOT, room

COUNT = 300


class Fake(Controller):
    """Drives an arc; what it says about it is a class variable."""

    said = None
    twist = (0.2, 0.5)

    def start(self, robot, world, period):
        return Session(self)


class Session(ControllerSession):
    def __init__(self, recipe):
        self.recipe = recipe

    def command(self, observation):
        return self.recipe.twist

    def evaluation(self):
        return self.recipe.said


def fake(said=None, twist=(0.2, 0.5)):
    kind = type("Fake", (Fake,), {"said": said, "twist": twist})
    return kind()


def seen(step, robots=(0, 1, 2)):
    count = len(robots)
    pose = np.tile([1.0, 2.0, 0.3], (count, 1))
    return Observations(
        now=step * PERIOD,
        robot=np.array(robots),
        pose=pose,
        twist=np.zeros((count, 2)),
        foot=pose[:, :2],
        points=np.array([(3.0, 3.0)]),
        begin=np.zeros(count, int),
        end=np.ones(count, int),
        yaw=np.full(count, np.nan),
        speed=np.ones(count),
        fleet_pose=np.zeros((3, 3)),
    )


def drive(controller, settings, steps=1):
    evaluations = Evaluations(settings, 3)
    session = observed(controller, evaluations).start_fleet((ROBOT,) * 3, room(), PERIOD, 7)
    found = []
    for step in range(steps):
        session.command(seen(step))
        found.append(evaluations.take())
    return found


def weighed(**changes):
    pose = np.zeros((COUNT, 40, 3))
    pose[..., 0] = np.arange(COUNT)[:, None]
    pose[..., 1] = np.arange(40)
    values = {"pose": pose, "cost": np.arange(COUNT) * 1.0, "chosen": pose[7], "scores": {"a": 2.0, "b": 5.0}}
    return Evaluation(**values | changes)


def test_only_the_robots_and_periods_that_are_asked_for_are_collected():
    found = drive(fake(weighed()), RecordedTrajectories(robots=(0, 2), every=3), steps=7)
    assert [[each.robot for each in step] for step in found] == [[0, 2], [], [], [0, 2], [], [], [0, 2]]


def test_samples_are_thinned_from_the_first_to_the_last_and_the_chosen_one_comes_first():
    ((found,),) = drive(fake(weighed()), RecordedTrajectories())
    assert found.pose.shape == (1 + SAMPLES, POSES, 3)
    assert found.pose.dtype == np.float32
    assert found.chosen.tolist() == [True] + [False] * SAMPLES
    assert found.cost[0] == 7.0
    assert found.pose[[0, 1, -1], 0, 0].tolist() == [7, 0, COUNT - 1]
    assert (found.pose[1:, 0, 0] == found.cost[1:]).all()
    assert found.pose[0, [0, -1], 1].tolist() == [0, 39]


def test_the_arc_of_the_command_stands_for_a_trajectory_that_is_not_told():
    ((found,),) = drive(fake(), RecordedTrajectories())
    assert found.chosen.tolist() == [True]
    assert np.isnan(found.cost).all()
    step, pose = 1e-4, np.array([1.0, 2.0, 0.3])
    for _ in range(10_000):  # Euler's method as the oracle
        pose += step * np.array([0.2 * np.cos(pose[2]), 0.2 * np.sin(pose[2]), 0.5])
    np.testing.assert_allclose(found.pose[0, -1], pose, atol=1e-4)


def test_without_an_admissible_command_there_are_samples_and_no_chosen_one():
    ((found,),) = drive(fake(weighed(chosen=None, scores={}), twist=None), RecordedTrajectories())
    assert not found.chosen.any()
    assert len(found.pose) == SAMPLES
    assert drive(fake(twist=None), RecordedTrajectories()) == [[]]


def test_commands_are_those_of_the_controller_itself():
    plain = fake().start_fleet((ROBOT,) * 3, room(), PERIOD).command(seen(0))
    session = observed(fake(weighed()), Evaluations(RecordedTrajectories(), 3)).start_fleet(
        (ROBOT,) * 3, room(), PERIOD
    )
    assert np.array_equal(session.command(seen(0)), plain)
    assert type(observed(fake(), Evaluations(RecordedTrajectories(), 3))).__name__ == "Fake"


@pytest.mark.parametrize(
    "wrong",
    [
        "text",
        weighed(cost=np.zeros(COUNT - 1)),
        weighed(cost=np.full(COUNT, np.nan)),
        weighed(pose=np.zeros((COUNT, 3))),
        weighed(pose=np.full((COUNT, 4, 3), np.inf)),
        weighed(chosen=np.zeros((0, 3))),
        weighed(scores={"a": np.nan}),
    ],
)
def test_an_evaluation_that_breaks_the_contract_is_refused(wrong):
    with pytest.raises(BrokenContractError, match="the evaluation of robot 0"):
        drive(fake(wrong), RecordedTrajectories())


def test_a_robot_that_does_not_exist_is_refused():
    with pytest.raises(InputError, match="there is no robot 3"):
        Evaluations(RecordedTrajectories(robots=(0, 3)), 3)
