"""Asks the controllers of some robots what they weighed, and thins it out for the recording."""

from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.config.settings import RecordedTrajectories
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.execution.evaluation import Evaluation
from mrpbench_core.model.execution.observation import Observations

SAMPLES, POSES = 50, 16
"""Sampled trajectories of a robot and control period that are recorded at most, and poses of each."""
AHEAD = 1.0
"""Seconds for which a command is continued if its controller does not tell its trajectory."""


@attrs.frozen(kw_only=True, eq=False)
class RecordedEvaluation:
    """An evaluation as it is recorded."""

    robot: int
    pose: Float
    """f4[k,POSES,3]: the chosen trajectory first, if there is one."""
    cost: Float
    """f8[k], NaN = not known."""
    chosen: Bool
    """bool[k]."""
    scores: dict[str, float]


class Evaluations:
    """What has been weighed since the last control period.

    Args:
        settings: which robots, and how often.
        robots: number of robots in the fleet.

    Raises:
        InputError: a robot does not exist.
    """

    def __init__(self, settings: RecordedTrajectories, robots: int) -> None:
        for robot in settings.robots:
            if robot >= robots:
                raise InputError(
                    f"recording.trajectories.robots: there is no robot {robot}", hint=f"the last one is {robots - 1}"
                )
        self._robots, self._every = frozenset(settings.robots), settings.every
        self._evaluations: list[RecordedEvaluation] = []

    def take(self) -> list[RecordedEvaluation]:
        """Return what was weighed, once."""
        evaluations, self._evaluations = self._evaluations, []
        return evaluations

    def collect(self, session: FleetControllerSession, observations: Observations, twist: Float, period: float) -> None:
        """Ask for the evaluations that are due.

        Raises:
            BrokenContractError: an evaluation is not what its class says.
        """
        if round(observations.now / period) % self._every:
            return
        for row, robot in enumerate(observations.robot.tolist()):
            if robot not in self._robots:
                continue
            evaluation: Any = session.evaluation(robot)
            if evaluation is not None and (fault := _fault(evaluation)):
                raise BrokenContractError(f"the evaluation of robot {robot}: {fault}")
            if not np.isnan(twist[row]).any() and (evaluation is None or evaluation.chosen is None):
                arc = _arc(observations.pose[row], twist[row])
                evaluation = Evaluation(pose=arc[None][:0], cost=np.empty(0)) if evaluation is None else evaluation
                evaluation = attrs.evolve(evaluation, chosen=arc)
            if evaluation is not None:
                self._evaluations.append(_thinned(robot, evaluation))


def _fault(evaluation: Any) -> str:
    """What is wrong with an evaluation, or an empty text."""
    if not isinstance(evaluation, Evaluation):
        return f"is {evaluation!r:.60}"
    pose: Any = evaluation.pose
    cost: Any = evaluation.cost
    chosen: Any = evaluation.chosen
    if not isinstance(pose, np.ndarray) or pose.ndim != 3 or pose.shape[2] != 3 or (len(pose) and not pose.shape[1]):
        return "`pose` is not f8[m,p,3]"
    if (
        not isinstance(cost, np.ndarray)
        or cost.shape != (len(pose),)
        or np.isnan(cost).any()
        or (cost == -np.inf).any()
    ):
        return f"`cost` is not f8[{len(pose)}] without NaN and -inf"
    is_path = chosen is None or (isinstance(chosen, np.ndarray) and chosen.ndim == 2 and chosen.shape[1:] == (3,))
    if not is_path or (chosen is not None and not len(chosen)):
        return "`chosen` is not f8[q,3]"
    if not np.isfinite(pose).all() or (chosen is not None and not np.isfinite(chosen).all()):
        return "a pose is not finite"
    if not np.isfinite(list(evaluation.scores.values())).all():
        return "a score is not finite"
    return ""


def _arc(pose: Float, twist: Float) -> Float:
    """Poses f8[POSES,3] of a command that is continued."""
    time = np.linspace(0.0, AHEAD, POSES)
    ahead, turn = twist.tolist()
    yaw = pose[2] + turn * time
    if abs(turn) < 1e-9:
        x, y = pose[0] + ahead * time * np.cos(pose[2]), pose[1] + ahead * time * np.sin(pose[2])
    else:
        radius = ahead / turn
        x = pose[0] + radius * (np.sin(yaw) - np.sin(pose[2]))
        y = pose[1] - radius * (np.cos(yaw) - np.cos(pose[2]))
    return np.column_stack([x, y, yaw])


def _thinned(robot: int, evaluation: Evaluation) -> RecordedEvaluation:
    count = len(evaluation.pose)
    samples = np.unique(np.linspace(0, count - 1, min(count, SAMPLES)).round().astype(int))
    pose = evaluation.pose[samples][:, _spread(evaluation.pose.shape[1])] if count else np.empty((0, POSES, 3))
    cost = evaluation.cost[samples]
    if evaluation.chosen is not None:
        pose = np.concatenate([evaluation.chosen[None, _spread(len(evaluation.chosen))], pose])
        cost = np.append(sum(evaluation.scores.values()) if evaluation.scores else np.nan, cost)
    chosen = np.zeros(len(pose), bool)
    chosen[:1] = evaluation.chosen is not None
    return RecordedEvaluation(
        robot=robot, pose=pose.astype("f4"), cost=cost, chosen=chosen, scores={**evaluation.scores}
    )


def _spread(count: int) -> np.ndarray:
    """Indices i8[POSES] of poses from the first to the last of `count`."""
    return np.linspace(0, count - 1, POSES).round().astype(int)
