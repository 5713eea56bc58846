"""The paths of a fleet on its global costmaps."""

from collections.abc import Sequence
from typing import NamedTuple

import attrs
import numpy as np
from mrpbench_controllers_local.settings import RobotSettings
from mrpbench_native.local import Fleet

from mrpbench_core.api import FleetControllerSession
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.execution.observation import Observations


class Replanning(NamedTuple):
    """When robots plan, and to where."""

    frequency: float
    """plans per second and robot."""
    tolerance: float
    """metres from an occupied goal to which a robot may plan instead."""


class GlobalPlannerSession(FleetControllerSession):
    """Plans the paths of all robots, and gives them to another controller.

    Args:
        primary: follows the paths.
        replanning: when robots plan, and to where.
        robots: settings of the costmap of each.
        walls: f8[S,4] of the static map; none if the costmaps do not know them.
    """

    def __init__(
        self, primary: FleetControllerSession, replanning: Replanning, robots: Sequence[RobotSettings], walls: Float
    ) -> None:
        super().__init__(())
        self._primary, self._replanning = primary, replanning
        sides = [np.hypot(each.values["width"], each.values["height"]) for each in robots]
        self._maps = Fleet(walls=walls, reach=float(max(sides, default=1.0)), threads=1)
        for each in robots:
            self._maps.add_costmap(settings=each.values, footprint=np.ascontiguousarray(each.footprint, float))
        self._path: list[Float | None] = [None] * len(robots)
        self._goal: Float = np.full((len(robots), 2), np.inf)
        self._due: Float = np.full(len(robots), -np.inf)
        """f8[n]: simulated seconds from which on each robot plans again."""

    def command(self, observations: Observations) -> Float:
        """The commands f8[k,2] of all rows, NaN where there is no path, or no command of the other controller."""
        for batch in observations.scans:
            self._maps.see(batch.stamp, batch.robot, observations.fleet_pose, batch.ranges)
        goal = observations.points[observations.end - 1]
        for row, robot in enumerate(observations.robot.tolist()):
            is_new = bool((goal[row] != self._goal[robot]).any())
            if is_new or observations.now >= self._due[robot] - 1e-9:
                one, tolerance = slice(row, row + 1), self._replanning.tolerance
                self._path[robot] = self._maps.plan(
                    observations.now, robot, observations.pose[one], goal[one], tolerance
                )
                self._goal[robot] = goal[row]
                self._due[robot] = observations.now + 1 / self._replanning.frequency
        planned, rows = self._with_paths(observations)
        twist = np.full((len(observations.robot), 2), np.nan)
        twist[rows] = self._primary.command(planned)
        return twist

    def _with_paths(self, observations: Observations) -> tuple[Observations, list[int]]:
        """The observations of the rows with a path, which is the planned one, and these rows."""
        rows, feet, points = [], [], []
        for row, robot in enumerate(observations.robot.tolist()):
            path = self._path[robot]
            if path is None:
                continue
            foot, rest = ahead(path, observations.pose[row, :2])
            rows.append(row)
            feet.append(foot)
            points.append(rest)
        counts = np.array([len(rest) for rest in points], np.int64)
        end = counts.cumsum()
        planned = attrs.evolve(
            observations,
            robot=observations.robot[rows],
            pose=observations.pose[rows],
            twist=observations.twist[rows],
            foot=np.array(feet).reshape(-1, 2),
            points=np.concatenate([*points, np.empty((0, 2))]),
            begin=end - counts,
            end=end,
            yaw=observations.yaw[rows],
            speed=observations.speed[rows],
        )
        return planned, rows

    def clear(self, robot: int) -> None:
        """Forget what scans have marked in both costmaps of a robot; it plans again at once."""
        self._maps.clear(robot)
        self._due[robot] = -np.inf
        self._primary.clear(robot)

    def is_free(self, robot: int, poses: Float) -> Bool:
        """Tell bool[k] at which poses f8[k,3] a robot fits, as far as the other controller knows."""
        return self._primary.is_free(robot, poses)

    def reroute(self, observations: Observations, row: int) -> Float | None:  # noqa: ARG002
        """Return None: paths lead around all that was seen."""
        return None

    def approach(self, observations: Observations, row: int, tolerance: float) -> Float | None:  # noqa: ARG002
        """Return None: the option `tolerance` is for this."""
        return None

    def failure_reason(self, robot: int) -> str:
        """Return why a robot had no command."""
        return "no path to the goal" if self._path[robot] is None else self._primary.failure_reason(robot)


def ahead(path: Float, place: Float) -> tuple[Float, Float]:
    """Return the point f8[2] of a path f8[k,2] that is nearest to a place f8[2], and the points f8[m,2] after it."""
    if len(path) < 2:
        return path[0], path
    start, along = path[:-1], np.diff(path, axis=0)
    square = (along**2).sum(axis=1)
    share = np.clip(((place - start) * along).sum(axis=1) / np.where(square > 0, square, 1.0), 0, 1)
    foot = start + share[:, None] * along
    leg = int(((foot - place) ** 2).sum(axis=1).argmin())
    return foot[leg], path[leg + 1 :]
