"""Latched messages at the start of a bag: run, map, sensor mounts, plans and goals."""

import json
from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.frames import transform
from mrpbench_exporters_rosbag2.messages import Topic, message, serialize
from mrpbench_exporters_rosbag2.plans import goal, goal_markers, plan
from mrpbench_exporters_rosbag2.scenery import navigation_graph, occupancy_map
from mrpbench_exporters_rosbag2.whole import whole


def opening(context: RunContext, stamp: int, resolution: float) -> Iterator[tuple[Topic, bytes]]:
    """Return all messages at the start, with the stamp `stamp` (nanoseconds)."""
    yield _run(context)
    yield whole(context)
    for index in range(len(context.world.levels)):
        yield occupancy_map(context.world, index, stamp, resolution)
    if context.world.vertices:
        yield navigation_graph(context.world, stamp)
    if any(robot.lidar for robot in context.fleet.robots):
        yield _mounts(context, stamp)
    names = context.fleet.names
    for robot in range(len(context.routes)):
        yield plan(context, robot, names[robot], stamp)
    for robot in range(len(context.goal)):
        yield goal(context, robot, names[robot], stamp)
    if context.goal:
        yield goal_markers(context, stamp)


def _run(context: RunContext) -> tuple[Topic, bytes]:
    """Identity of the run as JSON."""
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


def _mounts(context: RunContext, stamp: int) -> tuple[Topic, bytes]:
    """Mount of each robot's lidar."""
    topic = Topic("/tf_static", "tf2_msgs/TFMessage", latched=True)
    transforms = [
        transform(f"{name}/base_footprint", f"{name}/base_scan", np.array([*robot.lidar.mount, 0, 0, 0, 1]), stamp)
        for name, robot in zip(context.fleet.names, context.fleet.robots, strict=True)
        if robot.lidar
    ]
    return topic, serialize(topic.type, message(topic.type, transforms=transforms))
