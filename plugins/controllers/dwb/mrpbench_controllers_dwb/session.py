"""DWB for a fleet, in C++."""

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from mrpbench_native.local import Fleet

from mrpbench_controllers_dwb.critic import CriticSession, Trajectories
from mrpbench_controllers_dwb.critics import NativeCritic, RotateToGoal
from mrpbench_core.api import FleetControllerSession
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.arrays import Bool, Float
from mrpbench_core.model.execution import Observations
from mrpbench_core.model.fleet import RobotModel
from mrpbench_core.model.solids import segments
from mrpbench_core.model.world import World

if TYPE_CHECKING:
    from mrpbench_controllers_dwb.dwb import Dwb


class DwbSession(FleetControllerSession):
    """Controls all robots in one call, and tells why it commands what it does."""

    def __init__(self, options: "Dwb", robots: Sequence[RobotModel], world: World, period: float) -> None:
        super().__init__(())
        # No robot tells its controller its level, so that of several levels no walls are known.
        walls = segments(world) if len(world.levels) == 1 else np.empty((0, 4))
        told = [options.settings(robot, period) for robot in robots]
        if len(world.levels) > 1 and any(numbers["static_layer"] for numbers, _, _ in told):
            raise InputError(
                f"controller: static_layer is the map of one level, and {world.name} has {len(world.levels)}",
                hint="leave it out of the costmap's plugins",
            )
        reach = max((np.hypot(numbers["width"], numbers["height"]) for numbers, _, _ in told), default=1.0)
        self._fleet = Fleet(walls=np.ascontiguousarray(walls, float), reach=float(reach), threads=options.threads)
        self._others: list[list[tuple[str, float, CriticSession]]] = []
        goal = options.goal_options()
        for robot, (numbers, footprint, critics) in zip(robots, told, strict=True):
            native = [critic for critic in critics if isinstance(critic, NativeCritic)]
            self._fleet.add(
                settings=numbers,
                footprint=np.ascontiguousarray(footprint, float),
                critics=[
                    (
                        type(critic).__name__,
                        critic.scale,
                        critic.parameters | (goal if isinstance(critic, RotateToGoal) else {}),
                    )
                    for critic in native
                ],
            )
            others = [critic for critic in critics if not isinstance(critic, NativeCritic) and critic.scale]
            started = [(type(critic).__name__, critic.scale, critic.start(robot, world)) for critic in others]
            self._others.append(started)
        self._seen: Observations | None = None
        self._row: dict[int, int] = {}

    def command(self, observations: Observations) -> Float:
        """Commands f8[k,2] of all robots with a row."""
        seen = observations
        for batch in seen.scans:
            self._fleet.see(batch.stamp, batch.robot, seen.fleet_pose, batch.ranges)
        self._seen = seen
        scored = any(self._others)
        if scored:
            self._row = {robot: row for row, robot in enumerate(seen.robot.tolist())}
        return self._fleet.command(
            now=seen.now,
            robot=seen.robot,
            pose=seen.pose,
            twist=seen.twist,
            foot=seen.foot,
            points=seen.points,
            begin=seen.begin,
            end=seen.end,
            yaw=seen.yaw,
            speed=seen.speed,
            tolerance=seen.tolerance,
            score=self._score if scored else None,
        )

    def clear(self, robot: int) -> None:
        """Forget what one robot's scans have marked."""
        self._fleet.clear(robot)

    def is_free(self, robot: int, poses: Float) -> Bool:
        """Tell for each pose f8[k,3] whether one robot fits there, as far as its costmap shows."""
        return self._fleet.is_free(robot, np.ascontiguousarray(poses, float)).astype(bool)

    def reroute(self, observations: Observations, row: int) -> Float | None:
        """A way around what blocks the path of one row on its robot's costmap."""
        x, y, _ = observations.pose[row].tolist()
        return self._fleet.reroute(int(observations.robot[row]), x, y, observations.path(row))

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:
        """A way to the free place nearest to where the path of one row ends."""
        x, y, _ = observations.pose[row].tolist()
        return self._fleet.approach(int(observations.robot[row]), x, y, observations.path(row), tolerance)

    def failure_reason(self, robot: int) -> str:
        """Why the last trajectories of a robot were dropped, the most frequent reasons first."""
        reasons = Counter(self.explain(robot)["reason"])
        return ", ".join(f"{count} × {reason}" for reason, count in reasons.most_common(3) if reason)

    def explain(self, robot: int) -> dict[str, Any]:
        """What the last command of a robot was chosen from.

        `critics`: names; `twist` f8[m,2]; `pose` f8[m,p,3]; `score` f8[critics,m] raw; `total` f8[m]; `reason`: why
        each was dropped, or an empty text. Trajectories that could not win were not looked at closely unless
        `short_circuit_trajectory_evaluation` is false.
        """
        return dict(self._fleet.explain(robot))

    def costmap(self, robot: int) -> tuple[Float, float, float, float]:
        """Costs f8[rows,columns] of a robot's costmap, x and y of its lower left corner, and the inscribed radius."""
        return self._fleet.costmap(robot)

    def _score(self, robot: int, twist: Float, pose: Float) -> Float:
        """What the critics in Python say."""
        assert self._seen is not None
        row = self._row[robot]
        trajectories = Trajectories(twist=twist, pose=pose, path=self._seen.path(row), yaw=float(self._seen.yaw[row]))
        total = np.zeros(len(twist))
        for name, scale, critic in self._others[robot]:
            scores = np.asarray(critic.score(trajectories), float)
            if scores.shape != total.shape or np.isnan(scores).any():
                raise BrokenContractError(f"the critic {name} returned {scores!r} for {len(total)} trajectories")
            total += scale * scores
        return total
