"""The messages with plans and goals of the robots."""

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int, Int16
from mrpbench_core.model.common.geometry import facing
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.marker import ARROW, colour_of, marker
from mrpbench_exporters_rosbag2.messages import SECOND, Topic, header, message, pose, serialize, spatial


def plan(context: RunContext, robot: int, name: str, stamp: int) -> tuple[Topic, bytes]:
    """One robot's first path; the stamp of each pose is when the plan has the robot there."""
    return path(context, name, context.routes[robot], stamp + _due(context, robot), stamp)


def path(context: RunContext, name: str, route: Route, due: Int, stamp: int) -> tuple[Topic, bytes]:
    """A robot's path; `due` i8[k+1] are the stamps (nanoseconds) of its poses."""
    topic = Topic(f"/{name}/plan", "nav_msgs/Path", latched=True)
    full = spatial(facing(route.waypoint), _elevation(context, route.level))
    poses = [
        message("geometry_msgs/PoseStamped", header=header(int(when), "map"), pose=pose(values))
        for when, values in zip(due, full, strict=True)
    ]
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), poses=poses))


def goal(context: RunContext, robot: int, name: str, stamp: int) -> tuple[Topic, bytes]:
    """Goal of one robot: the end of its path."""
    topic = Topic(f"/{name}/goal_pose", "geometry_msgs/PoseStamped", latched=True)
    full = _goal_pose(context, robot)
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), pose=pose(full)))


def goal_markers(context: RunContext, stamp: int) -> tuple[Topic, bytes]:
    """An arrow at every goal, in the colour of its robot."""
    topic = Topic("/goals", "visualization_msgs/MarkerArray", latched=True)
    arrows = [
        marker(
            "goals", robot, ARROW, (0.3, 0.06, 0.06), colour_of(robot), values=_goal_pose(context, robot), stamp=stamp
        )
        for robot in range(len(context.goal))
    ]
    return topic, serialize(topic.type, message(topic.type, markers=arrows))


def _goal_pose(context: RunContext, robot: int) -> Float:
    """Goal f8[7]; a goal without yaw gets the yaw with which the robot arrives."""
    planar, z = np.array(context.goal[robot]), 0.0
    if context.routes:
        route = context.routes[robot]
        planar[2] = facing(route.waypoint)[-1, 2] if np.isnan(planar[2]) else planar[2]
        z = float(_elevation(context, route.level[-1:])[0])
    return spatial(np.nan_to_num(planar), z)


def _due(context: RunContext, robot: int) -> Int:
    """Planned arrival i8[k+1] at each waypoint of a route, nanoseconds from the start."""
    timed = context.result.plan
    count = len(context.routes[robot].waypoint)
    if timed is None or len(timed.paths[robot]) + 1 != count:
        return np.zeros(count, np.int64)
    ticks = np.concatenate([[0], timed.paths[robot].leave])
    due: Int = np.rint(ticks * context.problem.roadmap.tick * SECOND).astype(np.int64)
    return due


def _elevation(context: RunContext, levels: Int16) -> Float:
    """Height of each of `levels`, metres."""
    return np.array([context.world.levels[level].elevation for level in levels])
