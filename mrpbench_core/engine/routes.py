"""From a plan on the roadmap to routes in metres."""

import numpy as np

from mrpbench_core.model.execution import Route
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.world import World


def build_routes(problem: Problem, plan: Plan, final_yaw: np.ndarray, speed_limits: np.ndarray) -> tuple[Route, ...]:
    """One route per robot: the positions and prescribed yaws of its vertices.

    Args:
        problem: gives the roadmap and the starts.
        plan: a plan of `problem`.
        final_yaw: f8[n] radians wanted at the end, NaN = any.
        speed_limits: f8[E] m/s, inf = none.
    """
    roadmap = problem.roadmap
    routes = []
    for robot, path in enumerate(plan.paths):
        vertices = path.vertices(roadmap, int(problem.start[robot]))
        waypoint = np.column_stack([roadmap.position[vertices], roadmap.heading[vertices]])
        if not np.isnan(final_yaw[robot]):
            waypoint[-1, 2] = final_yaw[robot]
        speed = np.where(path.edge >= 0, speed_limits[path.edge] if len(speed_limits) else np.inf, np.inf)
        routes.append(Route(waypoint=waypoint, level=roadmap.level[vertices], speed=speed))
    return tuple(routes)


def speed_limits(world: World, roadmap: Roadmap) -> np.ndarray:
    """m/s on each edge of the roadmap, f8[E]: what its duration implies where the world has speed limits, else inf."""
    if not any(lane.speed_limit > 0 for lane in world.lanes) or not len(roadmap.edges):
        return np.full(len(roadmap.edges), np.inf)
    span = roadmap.position[roadmap.edges[:, 1]] - roadmap.position[roadmap.edges[:, 0]]
    ticks = np.where(roadmap.duration > 0, roadmap.duration, np.iinfo("i4").max).min(axis=0)
    limits: np.ndarray = np.hypot(span[:, 0], span[:, 1]) / (ticks * roadmap.tick)
    return limits


def placements(routes: tuple[Route, ...], start_yaw: np.ndarray) -> np.ndarray:
    """Where the simulator puts the robots, f8[n,3]: the first waypoints, facing `start_yaw` (0 where it is NaN).

    The yaw must not depend on the plan, or planners would be compared from different starts.
    """
    poses = np.array([route.waypoint[0] for route in routes])
    poses[:, 2] = np.where(np.isnan(start_yaw), 0.0, start_yaw)
    return poses
