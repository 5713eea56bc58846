"""Routes in metres, speed limits and start poses."""

import attrs
import numpy as np

from mrpbench_core.model.runs.routing import Router, speed_limits, start_poses
from mrpbench_core.model.worlds.world import Lane

ANY = np.array([np.nan, np.nan])


def test_a_route_follows_the_vertices_of_the_path(run_context):
    free = np.full(4, np.inf)
    routes = Router(run_context.problem, ANY, free)(run_context.result.plan)
    assert tuple(routes) == run_context.routes


def test_the_last_waypoint_takes_the_yaw_of_the_goal(run_context):
    routes = Router(run_context.problem, np.array([1.5, np.nan]), np.full(4, np.inf))(run_context.result.plan)
    assert routes[0].waypoint[-1, 2] == 1.5
    assert np.isnan(routes[1].waypoint[:, 2]).all()


def test_speed_limits_count_only_where_the_world_has_some(run_context):
    world, roadmap = run_context.world, run_context.problem.roadmap
    assert np.isinf(speed_limits(world, roadmap)).all()
    limited = attrs.evolve(world, lanes=(Lane(start=0, end=1, speed_limit=0.3),))
    np.testing.assert_allclose(speed_limits(limited, roadmap), 0.5)  # 1 m in one tick of 2 s


def test_robots_start_at_their_first_waypoint_with_any_plan(run_context):
    np.testing.assert_array_equal(start_poses(run_context.routes, ANY), [[0.5, 0.5, 0], [1.5, 0.5, 0]])
    assert start_poses(run_context.routes, np.array([np.nan, 2.0]))[:, 2].tolist() == [0, 2]
