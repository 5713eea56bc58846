"""Checks that the critics of every controller must pass; the suite of a controller derives from them."""

from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_controllers_local.critics import Critic, CriticSession, NativeCritic, Trajectories
from mrpbench_core.api.controller import Controller
from mrpbench_core.api.predictor import Prediction, Predictor, PredictorSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.room import PERIOD, ROBOT, driven, room
from mrpbench_core.testing.suites.component import ComponentConformance
from mrpbench_core.testing.suites.controller import STRAIGHT, drive

PATH = np.array([(1.0, 1.0), *STRAIGHT])
POSES = 8


class CriticConformance(ComponentConformance):
    """Checks of the critics of a controller."""

    def make(self) -> Critic:
        """Return the critic to check."""
        raise NotImplementedError("define make(self) and return the critic to check")

    def controller(self) -> Controller:
        """Return the controller with this critic alone."""
        raise NotImplementedError("define controller(self) and return the controller with this critic alone")

    def session(self) -> CriticSession:
        """A session for one robot in a room."""
        critic = self.make()
        if isinstance(critic, NativeCritic):
            raise Skip("it runs in C++, inside of its controller")
        return critic.start(ROBOT, room())

    def test_scores_each_trajectory(self) -> None:
        session = self.session()
        for samples in (1, 2, 30):
            scores(session, trajectories(samples))

    def test_scores_paths_without_and_with_a_yaw(self) -> None:
        for yaw in (float("nan"), 0.5):
            scores(self.session(), attrs.evolve(trajectories(5), yaw=yaw))

    def test_the_same_trajectories_have_the_same_scores(self) -> None:
        one, other = (scores(self.session(), trajectories(10)) for _ in range(2))
        require(np.array_equal(one, other), "scores differ the second time: keep all state in the session")

    def test_does_not_change_the_trajectories(self) -> None:
        scored, copy = trajectories(10), trajectories(10)
        scores(self.session(), scored)
        for name in ("twist", "pose", "path"):
            same = np.array_equal(getattr(scored, name), getattr(copy, name))
            require(same, f"changes `trajectories.{name}`: copy it before writing")

    def test_its_controller_commands_a_robot_with_it(self) -> None:
        """The robot may stand, because a critic may forbid every motion."""
        driving = drive(self.controller().start(ROBOT, room(), PERIOD), STRAIGHT, seconds=1.0)
        require(np.isfinite(driving.twist).all(), "the controller commands a speed that is not finite with this critic")


class NothingMoves(Predictor):
    """Predicts nothing, for critics that need a prediction."""

    def start(self, robots: Sequence[RobotModel], world: World) -> PredictorSession:  # noqa: ARG002 - in any world
        """Begin to predict nothing."""
        return _Nothing()


class _Nothing(PredictorSession):
    def observe(self, pose: Float, scans: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:  # noqa: ARG002
        return tuple(scans)

    def predict(self, now: float) -> Prediction:  # noqa: ARG002
        return Prediction(step=0.1, robot=np.zeros(0, np.int32), place=np.zeros((0, 31, 2)), radius=np.zeros(0))

    def constrained(self, problem: Problem, now: float) -> Problem:  # noqa: ARG002
        return problem


def trajectories(samples: int) -> Trajectories:
    """Arcs of equal duration from the start of a straight path."""
    twist = np.column_stack([np.linspace(0.0, 0.2, samples), np.linspace(-1.0, 1.0, samples)])
    pose = np.tile([1.0, 1.0, 0.0], (samples, 1))
    poses = [pose]
    for _ in range(POSES - 1):
        poses.append(driven(poses[-1], twist, 0.2))
    return Trajectories(twist=twist, pose=np.stack(poses, axis=1), path=PATH.copy(), yaw=float("nan"))


def scores(session: CriticSession, trajectories: Trajectories) -> Float:
    """The scores of a session, one number for each trajectory."""
    values: Any = session.score(trajectories)
    count = len(trajectories.twist)
    right = isinstance(values, np.ndarray) and values.shape == (count,)
    require(right, f"score returns {values!r} for {count} trajectories: return f8[{count}]")
    require(not np.isnan(values).any(), "a score is NaN: return infinity for what must not be driven")
    require(not (values == -np.inf).any(), "a score is -infinity, which no other critic can outweigh")
    return np.asarray(values, float)
