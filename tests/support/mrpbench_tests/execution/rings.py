"""Rings of robots around 2 x k cells that rotate again and again, driven by a navigator in a simulator."""

from itertools import combinations

import attrs
import numpy as np
from mrpbench_navigators_waypoints import Waypoints

from mrpbench_core.api import Controller, Dispatcher, Simulator
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.arrays import Int
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.model.worlds.world import Level, World

PERIOD = 0.05
"""Control period, seconds."""
APART = 10
"""Cells between the corners of two rings."""


def around(columns: int) -> Int:
    """The cells i8[2 k,2] of two rows and k columns, counter-clockwise."""
    lower = np.column_stack([np.arange(columns), np.zeros(columns, int)])
    return np.concatenate([lower, lower[::-1] + (0, 1)])


@attrs.frozen(kw_only=True)
class RingsResult:
    """The outcome of an execution of rings of robots."""

    rotations: int
    """Rotations that all robots of a ring completed, summed over rings."""
    contacts: int
    """Control periods and pairs of robots that touched."""
    gap: float
    """Smallest distance in metres between the discs of two robots of a ring."""


def ring_problem(cell: float, rings: int, turns: int, seed: int, columns: int = 2) -> tuple[Fleet, Problem, Plan]:
    """Fleet, problem and plan of rings that rotate `turns` times on cells of a side in metres, in drawn directions."""
    size = 2 * columns
    random = np.random.default_rng(seed)
    model = load_robot("turtlebot3_burger")
    base = size * np.arange(rings)[:, None]
    corners = np.concatenate([around(columns) + (APART * ring, 0) for ring in range(rings)]) * cell
    step = np.arange(size)
    both = [np.stack([base + step, base + (step + way) % size], axis=-1) for way in (1, -1)]
    edges = np.stack(both, axis=1).reshape(-1, 2)
    roadmap = Roadmap(
        position=corners,
        level=np.zeros(len(corners), np.int16),
        heading=np.full(len(corners), np.nan),
        edges=edges,
        duration=np.ones((1, len(edges)), np.int32),
        tick=1.0,
    )
    paths, goals, time = [], [], np.arange(turns)
    for ring in range(rings):
        ways = random.integers(0, 2, turns)
        at = np.cumsum([0, *np.where(ways, -1, 1)]) % size
        for robot_at in range(size):
            vertex = (at + robot_at) % size
            paths.append(RobotPath(edge=2 * size * ring + size * ways + vertex[:-1], enter=time, leave=time + 1))
            goals.append((((size * ring + int(vertex[-1])),),))
    count = size * rings
    fleet = Fleet(robots=(model,) * count)
    problem = Problem(
        roadmap=roadmap,
        profile=np.zeros(count, np.int32),
        radius=fleet.radii,
        start=np.arange(count, dtype=np.int32),
        ready=np.zeros(count, np.int64),
        goals=tuple(goals),
    )
    return fleet, problem, Plan(paths=tuple(paths))


def rotate(
    dispatcher: Dispatcher,
    controller: Controller,
    simulator: Simulator,
    *,
    cell: float,
    rings: int = 4,
    turns: int = 5,
    seed: int = 0,
    columns: int = 2,
    navigator: Waypoints | None = None,
    limit: float = 60.0,
) -> RingsResult:
    """Execute a plan of `ring_problem`, from drawn yaws, for at most `limit` simulated seconds a turn."""
    fleet, problem, plan = ring_problem(cell, rings, turns, seed, columns)
    count = len(fleet)
    world = World(name="empty", levels=(Level(name="L1"),))
    yaw = np.random.default_rng(seed + 1).uniform(-np.pi, np.pi, count)
    pose = np.column_stack([problem.roadmap.position[problem.start], yaw])
    routes = Router(problem, np.full(count, np.nan), np.full(len(problem.roadmap.edges), np.inf))(plan)
    session = dispatcher.start(problem, plan)
    driver = (navigator or Waypoints()).start(fleet, world, routes, controller, PERIOD, seed)
    reached = cleared = np.zeros(count, "i4")
    contacts, gap = 0, np.inf
    size = 2 * columns
    ring = np.arange(count).reshape(rings, size)
    one, other = (ring[:, list(index)].ravel() for index in zip(*combinations(range(size), 2), strict=True))
    reach = fleet.radii[one] + fleet.radii[other]
    with simulator.open(world, fleet, pose, seed, PERIOD) as simulation:
        state, mode = simulation.state, np.zeros(count, "u1")
        for step in range(int(limit * turns / PERIOD)):
            now = step * PERIOD
            view = FleetView(
                revision=0, reached=reached, cleared=cleared, pose=state.pose, level=state.level, mode=mode
            )
            orders = session.update(now, view)
            seen = FleetObservation(
                estimate=Estimate(pose=state.pose),
                odometry=Odometry(pose=state.pose, twist=state.twist),
                level=state.level,
                scans=simulation.scans(),
            )
            motion = driver.step(now, seen, orders)
            reached, cleared, mode = motion.reached, motion.cleared, motion.mode
            if (reached == turns).all():
                break
            state = simulation.step(Inputs(twist=motion.twist))
            contacts += len(state.contacts)
            apart = np.hypot(*(state.pose[one, :2] - state.pose[other, :2]).T)
            gap = min(gap, float((apart - reach).min()))
    return RingsResult(rotations=int(reached.reshape(rings, size).min(axis=1).sum()), contacts=contacts, gap=gap)
