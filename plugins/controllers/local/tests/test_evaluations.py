"""What native controllers tell about their last command: samples, their costs, the chosen one and its scores."""

import numpy as np
import pytest
from mrpbench_controllers_dwb import BaseObstacle, CriticSession, Dwb, GoalDist, PathDist
from mrpbench_controllers_dwb import Critic as DwbCritic
from mrpbench_controllers_graceful import Graceful
from mrpbench_controllers_mppi import Mppi, MppiCritic, PathFollowCritic
from mrpbench_controllers_rotation_shim import RotationShim
from mrpbench_controllers_rpp import Rpp

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.observation import Observation, Observations, ScanBatch
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.fixtures.room import PERIOD

BURGER = load_robot("turtlebot3_burger")
BEAMS = BURGER.lidar.beams


class Left:
    """Prefers to turn left."""

    def start(self, robot, world):
        return LeftSession()


class LeftSession(CriticSession):
    def score(self, trajectories):
        return 1.0 - trajectories.pose[:, -1, 2]


class Never(DwbCritic):
    """Refuses all."""

    def start(self, robot, world):
        return NeverSession()


class NeverSession(CriticSession):
    def score(self, trajectories):
        return np.full(len(trajectories.twist), np.inf)


class DwbLeft(Left, DwbCritic):
    pass


class MppiLeft(Left, MppiCritic):
    pass


def told(controller, ranges=np.inf, path=((0.0, 0.0), (2.0, 0.0))):
    session = controller.start_fleet((BURGER,), World(name="w", levels=()), PERIOD)
    scan = ScanBatch(stamp=0.0, robot=[0], ranges=np.full((1, BEAMS), ranges))
    seen = Observation(now=0.0, pose=np.zeros(3), twist=np.zeros(2), path=np.array(path), scan=scan)
    return session.command(Observations.alone(seen))[0], session.evaluation(0)


def test_dwb_chooses_the_sample_of_the_lowest_cost_which_is_the_sum_of_its_scores():
    twist, found = told(
        Dwb(critics=(BaseObstacle(), PathDist(), GoalDist()), short_circuit_trajectory_evaluation=False)
    )
    best = found.cost.argmin()
    np.testing.assert_array_equal(found.chosen, found.pose[best])
    assert list(found.scores) == ["BaseObstacle", "PathDist", "GoalDist"]
    assert sum(found.scores.values()) == pytest.approx(found.cost[best])
    assert found.chosen[-1, 0] > 0.1
    assert twist[0] > 0


def test_refused_samples_have_infinite_costs():
    twist, found = told(Dwb(short_circuit_trajectory_evaluation=False), ranges=0.25)
    assert np.isinf(found.cost).any()
    twist, found = told(Dwb(extra_critics=(Never(),)))
    assert np.isnan(twist).all()
    assert np.isinf(found.cost).all()
    assert found.chosen is None
    assert not found.scores


def test_the_plan_of_mppi_begins_with_its_command():
    twist, found = told(Mppi())
    assert len(found.cost) == len(found.pose) == 200
    assert found.chosen.shape == (57, 3)
    np.testing.assert_allclose(found.chosen[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(found.chosen[1], [twist[0] * PERIOD, 0.0, twist[1] * PERIOD], atol=1e-9)
    assert found.scores["PathFollowCritic"] > 0


def test_the_score_of_a_critic_of_mppi_is_within_the_costs_of_the_samples():
    _, found = told(Mppi(critics=(PathFollowCritic(),), gamma=0.0))
    assert found.cost.min() - 0.1 < found.scores["PathFollowCritic"] < found.cost.mean()


@pytest.mark.parametrize(
    ("controller", "weight"),
    [(Dwb(critics=(GoalDist(),), extra_critics=(DwbLeft(),)), 1.0), (Mppi(extra_critics=(MppiLeft(),)), 1.0)],
)
def test_critics_in_python_have_a_score_too(controller, weight):
    _, found = told(controller)
    name = [name for name in found.scores if name.endswith("Left")]
    assert len(name) == 1
    end = found.chosen[-1, 2]
    assert found.scores[name[0]] == pytest.approx(weight * (1.0 - end), abs=0.3)


@pytest.mark.parametrize("controller", [Rpp(), Graceful(), RotationShim(primary_controller=Rpp())])
def test_controllers_without_samples_leave_their_trajectory_to_the_engine(controller):
    twist, found = told(controller)
    assert twist[0] > 0
    assert found is None


def test_nothing_is_told_of_commands_without_samples():
    for controller in (Dwb(), Mppi()):
        assert told(controller, path=((0.0, 0.0), (0.01, 0.0)))[1] is None
    behind = ((0.0, 0.0), (-2.0, 0.0))
    shim = RotationShim(primary_controller=Mppi())
    assert told(shim, path=behind)[1] is None, "it turns on the spot"
    assert told(shim)[1] is not None
