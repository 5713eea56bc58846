"""From a plan on the roadmap to routes in metres."""

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int16
from mrpbench_core.model.execution.route import Route, Routes
from mrpbench_core.model.planning.plan import Paths, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.stairs import without_stairs
from mrpbench_core.model.worlds.world import World

PlanFilter = Literal["none", "mrp_bench_stairs"]


@attrs.frozen
class Router:
    """Turns plans of one problem into routes, one per robot: the positions and prescribed yaws of its vertices."""

    problem: Problem
    """Gives the roadmap and the starts."""
    final_yaw: Float
    """f8[n] radians wanted at the end, NaN = any."""
    speed_limits: Float
    """f8[E] m/s, inf = none."""
    plan_filter: PlanFilter = "none"

    def __call__(self, plan: Plan) -> Routes:
        """The routes of `plan`."""
        paths, roadmap = Paths.of(plan.paths), self.problem.roadmap
        vertices = paths.vertices(roadmap, self.problem.start)
        waypoint = np.column_stack([roadmap.position.take(vertices, axis=0), roadmap.heading.take(vertices)])
        level = roadmap.level.take(vertices)
        first = paths.first + np.arange(len(paths) + 1)
        speed = np.full(len(vertices), np.inf)
        if len(self.speed_limits):
            limits = np.where(paths.edge >= 0, self.speed_limits[paths.edge], np.inf)
            speed[np.arange(len(limits)) + paths.robot] = limits
        changed = ~np.isnan(self.final_yaw) if self.plan_filter == "none" else np.ones(len(paths), bool)
        for robot in np.flatnonzero(changed).tolist():
            rows = slice(*first[robot : robot + 2].tolist())
            waypoint[rows] = self._line(robot, waypoint[rows], level[rows])
        return Routes(first=first, waypoint=waypoint, level=level, speed=speed)

    def _line(self, robot: int, waypoint: Float, level: Int16) -> Float:
        """The waypoints f8[k+1,3] of a robot with the yaw wanted at the end, filtered."""
        if not np.isnan(self.final_yaw[robot]):
            waypoint[_end(waypoint, level) :, 2] = self.final_yaw[robot]
        if self.plan_filter == "none":
            return waypoint
        return _straightened(waypoint, without_stairs(waypoint[:, :2]))


def ends_of(routes: Sequence[Route]) -> tuple[tuple[float, float, float], ...]:
    """x, y (metres) and yaw (NaN = any) of the last waypoint of each route."""
    return tuple((float(x), float(y), float(yaw)) for x, y, yaw in (route.waypoint[-1] for route in routes))


def _end(waypoint: Float, level: Int16) -> int:
    """Index of the first waypoint f8[k,3] from which on nothing but waits follows."""
    elsewhere = (waypoint[:, :2] != waypoint[-1, :2]).any(axis=1) | (level != level[-1])
    return int(np.flatnonzero(np.append(True, elsewhere))[-1])


def _straightened(waypoint: Float, mask: Bool) -> Float:
    """Move the waypoints f8[k,3] that are not kept onto the straight line between those that are, at even distances.

    So segments keep their indices, and a robot that follows the route crosses the lines that were left out.
    """
    index = np.arange(len(waypoint))
    moved = waypoint.copy()
    for axis in (0, 1):
        moved[:, axis] = np.interp(index, index[mask], waypoint[mask, axis])
    moved[~mask, 2] = np.nan
    return moved


def speed_limits(world: World, roadmap: Roadmap) -> np.ndarray:
    """m/s on each edge of the roadmap, f8[E]: what its duration implies where the world has speed limits, else inf."""
    if not any(lane.speed_limit > 0 for lane in world.lanes) or not len(roadmap.edges):
        return np.full(len(roadmap.edges), np.inf)
    start, end = roadmap.edges[:, 0], roadmap.edges[:, 1]
    span = roadmap.position[end] - roadmap.position[start]
    ticks = np.where(roadmap.duration > 0, roadmap.duration, np.iinfo("i4").max).min(axis=0)
    length = np.hypot(span[:, 0], span[:, 1])
    drives = (roadmap.level[start] == roadmap.level[end]) & (length > 0)  # in a lift it is the lift that drives
    return np.where(drives, length / (ticks * roadmap.tick), np.inf)


def start_poses(routes: Sequence[Route], start_yaw: np.ndarray) -> np.ndarray:
    """The initial poses f8[n,3] of the robots: the first waypoints, facing `start_yaw` (0 where it is NaN).

    The yaw must not depend on the plan, or planners would be compared from different starts.
    """
    poses = np.array([route.waypoint[0] for route in routes])
    poses[:, 2] = np.where(np.isnan(start_yaw), 0.0, start_yaw)
    return poses
