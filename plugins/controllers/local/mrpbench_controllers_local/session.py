"""The session of a local controller, which controls a fleet in C++."""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from mrpbench_native.local import Fleet

from mrpbench_controllers_local.critics import CriticSession, NativeCritic, Trajectories
from mrpbench_controllers_local.settings import RobotSettings
from mrpbench_core.api import Evaluation, FleetControllerSession
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.predictor import PredictorSession
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.observation import Observations, ScanBatch
from mrpbench_core.model.worlds.solids import segments
from mrpbench_core.model.worlds.world import World


class LocalSession(FleetControllerSession):
    """Controls all robots in one call, and explains its commands.

    Args:
        name: of the controller in the native part.
        robots: each with its settings.
        world: the static map.
        threads: threads that share the robots.
        parameters_of: returns the options of a critic for the native part.
        seed: of the run; controllers that draw random numbers draw them by it and the index of the robot.
    """

    def __init__(
        self,
        name: str,
        robots: Sequence[tuple[RobotModel, RobotSettings]],
        world: World,
        threads: int,
        parameters_of: Callable[[NativeCritic], dict[str, Any]],
        seed: int = 0,
    ) -> None:
        super().__init__(())
        # Controllers are not told the level of their robot, so the walls of several levels cannot be used.
        walls = segments(world) if len(world.levels) == 1 else np.empty((0, 4))
        values = [settings.values for _, settings in robots]
        if len(world.levels) > 1 and any(each["static_layer"] for each in values):
            raise InputError(
                f"controller: static_layer is the map of one level, and {world.name} has {len(world.levels)}",
                hint="remove it from the plugins of the costmap",
            )
        reach = max((np.hypot(each["width"], each["height"]) for each in values), default=1.0)
        self._fleet = Fleet(walls=np.ascontiguousarray(walls, float), reach=float(reach), threads=threads)
        self._in_python: list[list[tuple[str, float, CriticSession]]] = []
        for robot, settings in robots:
            native = [critic for critic in settings.critics if isinstance(critic, NativeCritic)]
            self._fleet.add(
                controller=name,
                settings=settings.values,
                footprint=np.ascontiguousarray(settings.footprint, float),
                critics=[(type(critic).__name__, critic.weight, parameters_of(critic)) for critic in native],
                seed=seed,
            )
            others = [critic for critic in settings.critics if not isinstance(critic, NativeCritic) and critic.weight]
            started = [(type(critic).__name__, critic.weight, critic.start(robot, world)) for critic in others]
            for critic_name, _, session in started:
                if not isinstance(session, CriticSession):
                    what = type(session).__name__
                    raise BrokenContractError(f"the critic {critic_name} returned {what} instead of a session")
            self._in_python.append(started)
        self._scored = any(self._in_python)
        """Whether any robot has critics in Python."""
        self.prediction: PredictorSession | None = None
        """Predicts the objects that the robots see."""
        self._observations: Observations | None = None
        self._seen: tuple[ScanBatch, ...] | None = None
        """The scans of the next command, if it is known what they show."""
        self._row: dict[int, int] = {}

    def observe(self, now: float, scans: tuple[ScanBatch, ...], fleet_pose: Float) -> None:
        """Begin to update the costmaps that are due; other threads go on with it until one is read."""
        self._seen = scans
        if self.prediction is not None:
            scans = self._foresee(self.prediction, now, scans, fleet_pose)
        for batch in scans:
            self._fleet.see(batch.stamp, batch.robot, fleet_pose, batch.ranges)

    def command(self, observations: Observations) -> Float:
        """The commands f8[k,2] of all rows."""
        if self._seen is not observations.scans:
            self.observe(observations.now, observations.scans, observations.fleet_pose)
        self._observations, self._seen = observations, None
        if self._scored:
            self._row = {robot: row for row, robot in enumerate(observations.robot.tolist())}
        return self._fleet.command(observations, self._score if self._scored else None)

    def _foresee(
        self, prediction: PredictorSession, now: float, scans: tuple[ScanBatch, ...], fleet_pose: Float
    ) -> tuple[ScanBatch, ...]:
        """Tell the robots where objects will be; returns the scans without these objects, for the costmaps."""
        scans = prediction.observe(fleet_pose, scans)
        predicted = prediction.predict(now)
        if len(predicted.robot):
            self._fleet.foresee(predicted.robot, predicted.place, predicted.radius, predicted.step)
        return scans

    def clear(self, robot: int) -> None:
        """Forget what one robot's scans have marked."""
        self._fleet.clear(robot)

    def is_free(self, robot: int, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] one robot fits, as far as its costmap shows."""
        return self._fleet.is_free(robot, np.ascontiguousarray(poses, float)).astype(bool)

    def reroute(self, observations: Observations, row: int) -> Float | None:
        """Find a way around what blocks the path of one row on the costmap of its robot."""
        x, y, _ = observations.pose[row].tolist()
        return self._fleet.reroute(int(observations.robot[row]), x, y, observations.path(row))

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:
        """Find a way to the free place that is nearest to the end of the path of one row."""
        x, y, _ = observations.pose[row].tolist()
        return self._fleet.approach(int(observations.robot[row]), x, y, observations.path(row), tolerance)

    def failure_reason(self, robot: int) -> str:
        """Return why the last trajectories of a robot were rejected, the most frequent reasons first."""
        reasons = Counter(self.explain(robot).get("reason", ()))
        return ", ".join(f"{count} × {reason}" for reason, count in reasons.most_common(3) if reason)

    def explain(self, robot: int) -> dict[str, Any]:
        """Return what led to the last command of a robot, by name.

        `reason`: why trajectories, or the command, were rejected, empty texts for the others. Of `dwb`: `critics`:
        names; `twist` f8[m,2]; `pose` f8[m,p,3]; `score` f8[critics,m] raw; `total` f8[m]. Trajectories that cannot win
        are scored in part only, unless `short_circuit_trajectory_evaluation` is false.
        """
        return dict(self._fleet.explain(robot))

    def evaluation(self, robot: int) -> Evaluation | None:
        """Return the sampled and the chosen trajectory of controllers that sample; critics in Python share a score."""
        why = self.explain(robot)
        if "pose" not in why:
            return None
        scores = {}
        if "chosen" in why:
            others = " + ".join(name for name, _, _ in self._in_python[robot])
            scores = dict(zip((*why["critics"], others), why["chosen_score"].tolist(), strict=False))
        return Evaluation(pose=why["pose"], cost=why["cost"], chosen=why.get("chosen"), scores=scores)

    def costmap(self, robot: int) -> tuple[Float, float, float, float]:
        """Return a robot's costmap f8[rows,columns], its lower left corner x, y, and the inscribed radius."""
        return self._fleet.costmap(robot)

    def _score(self, robot: int, twist: Float, pose: Float) -> Float:
        """The sum of the scores of the critics in Python, f8[m]."""
        assert self._observations is not None
        row = self._row[robot]
        trajectories = Trajectories(
            twist=twist, pose=pose, path=self._observations.path(row), yaw=float(self._observations.yaw[row])
        )
        total = np.zeros(len(twist))
        for name, scale, critic in self._in_python[robot]:
            returned = critic.score(trajectories)
            try:
                scores = np.array(returned, float)
            except (TypeError, ValueError) as error:
                raise BrokenContractError(f"the critic {name} returned no scores: {error}") from error
            if scores.shape != total.shape or np.isnan(scores).any():
                raise BrokenContractError(f"the critic {name} returned {scores!r:.60} for {len(total)} trajectories")
            total += scale * scores
        return total
