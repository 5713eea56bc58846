"""From a plan on the roadmap to routes in metres."""

import numpy as np

from mrpbench_core.model.execution import Route
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem


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


def placements(routes: tuple[Route, ...], start_yaw: np.ndarray) -> np.ndarray:
    """Where the simulator puts the robots, f8[n,3]: the first waypoints, facing `start_yaw` (0 where it is NaN).

    The yaw must not depend on the plan, or planners would be compared from different starts.
    """
    poses = np.array([route.waypoint[0] for route in routes])
    poses[:, 2] = np.where(np.isnan(start_yaw), 0.0, start_yaw)
    return poses
