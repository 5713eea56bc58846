"""What is said once, at the start: the run, the maps, where sensors sit, plans and goals. All of it is latched."""

import json
from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.arrays import Float, Int, Int16
from mrpbench_core.model.run import RunContext
from mrpbench_exporters_rosbag2.frames import transform
from mrpbench_exporters_rosbag2.messages import SECOND, Topic, header, message, pose, serialize, spatial, time
from mrpbench_exporters_rosbag2.raster import rasterise

Latched = tuple[Topic, bytes]


def opening(context: RunContext, stamp: int, cell_size: float) -> Iterator[Latched]:
    """Every message of the start, stamped `stamp` (nanoseconds)."""
    yield _run(context)
    for index in range(len(context.world.levels)):
        yield _map(context, index, stamp, cell_size)
    if any(robot.lidar for robot in context.fleet.robots):
        yield _mounts(context, stamp)
    for robot in range(len(context.routes)):
        yield _plan(context, robot, stamp)
    for robot in range(len(context.goal)):
        yield _goal(context, robot, stamp)


def _run(context: RunContext) -> Latched:
    """What names this run, as JSON."""
    facts = {
        "run_id": context.run_id,
        "scenario_id": context.scenario.id,
        "world": context.world.name,
        "robots": [robot.name for robot in context.fleet.robots],
        "assigned": list(context.assigned),
        "period_s": context.period,
        "tick_s": context.problem.roadmap.tick,
        "plan_status": str(context.result.status),
    }
    topic = Topic("/run", "std_msgs/String", latched=True)
    return topic, serialize(topic.type, message(topic.type, data=json.dumps(facts)))


def _map(context: RunContext, index: int, stamp: int, cell_size: float) -> Latched:
    """`/map` for the first level, `/map_1` for the second, ..."""
    topic = Topic(f"/map_{index}" if index else "/map", "nav_msgs/OccupancyGrid", latched=True)
    raster = rasterise(context.world, index, cell_size)
    rows, columns = raster.shape
    info = message(
        "nav_msgs/MapMetaData",
        map_load_time=time(stamp),
        resolution=raster.cell_size,
        width=columns,
        height=rows,
        origin=pose(spatial(np.array([*raster.origin, 0.0]), context.world.levels[index].elevation)),
    )
    data = np.where(raster.blocked, 100, 0).astype(np.int8).reshape(-1)
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), info=info, data=data))


def _mounts(context: RunContext, stamp: int) -> Latched:
    """Where each robot's lidar sits."""
    topic = Topic("/tf_static", "tf2_msgs/TFMessage", latched=True)
    transforms = [
        transform(f"{name}/base_footprint", f"{name}/base_scan", np.array([*robot.lidar.mount, 0, 0, 0, 1]), stamp)
        for name, robot in zip(context.fleet.names, context.fleet.robots, strict=True)
        if robot.lidar
    ]
    return topic, serialize(topic.type, message(topic.type, transforms=transforms))


def _plan(context: RunContext, robot: int, stamp: int) -> Latched:
    """One robot's first path; the stamp of each pose is when the plan has the robot there."""
    topic = Topic(f"/{context.fleet.names[robot]}/plan", "nav_msgs/Path", latched=True)
    waypoints = facing(context.routes[robot].waypoint)
    full = spatial(waypoints, _elevation(context, context.routes[robot].level))
    poses = [
        message("geometry_msgs/PoseStamped", header=header(int(stamp + due), "map"), pose=pose(values))
        for due, values in zip(_due(context, robot), full, strict=True)
    ]
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), poses=poses))


def _goal(context: RunContext, robot: int, stamp: int) -> Latched:
    """Where one robot's path ends; a goal that leaves the yaw open gets the one the robot arrives with."""
    topic = Topic(f"/{context.fleet.names[robot]}/goal_pose", "geometry_msgs/PoseStamped", latched=True)
    planar, z = np.array(context.goal[robot]), 0.0
    if context.routes:
        route = context.routes[robot]
        planar[2] = facing(route.waypoint)[-1, 2] if np.isnan(planar[2]) else planar[2]
        z = float(_elevation(context, route.level[-1:])[0])
    full = spatial(np.nan_to_num(planar), z)
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), pose=pose(full)))


def _due(context: RunContext, robot: int) -> Int:
    """Planned arrival i8[k+1] at each waypoint of a route, nanoseconds from the start."""
    plan = context.result.plan
    count = len(context.routes[robot].waypoint)
    if plan is None or len(plan.paths[robot]) + 1 != count:
        return np.zeros(count, np.int64)
    ticks = np.concatenate([[0], plan.paths[robot].leave])
    due: Int = np.rint(ticks * context.problem.roadmap.tick * SECOND).astype(np.int64)
    return due


def _elevation(context: RunContext, levels: Int16) -> Float:
    """Height of each of `levels`, metres."""
    return np.array([context.world.levels[level].elevation for level in levels])


def facing(waypoints: Float) -> Float:
    """Waypoints f8[k,3] in which an open yaw (NaN) is the way the robot drives on, or came from where it only waits."""
    turned = np.array(waypoints)
    ahead = np.diff(turned[:, :2], axis=0)
    moves = (ahead != 0).any(axis=1)
    yaw = 0.0
    if moves.any():
        first = ahead[moves][0]
        yaw = float(np.arctan2(first[1], first[0]))
    for index in range(len(turned)):
        if index < len(ahead) and moves[index]:
            yaw = float(np.arctan2(ahead[index, 1], ahead[index, 0]))
        if np.isnan(turned[index, 2]):
            turned[index, 2] = yaw
    return turned
