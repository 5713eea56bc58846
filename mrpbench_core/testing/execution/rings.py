"""Rings of four robots on 2 x 2 cells that rotate again and again, driven by a navigator in a simulator."""

from itertools import combinations

import attrs
import numpy as np

from mrpbench_core.api import Controller, Dispatcher, Simulator
from mrpbench_core.builtin.navigators.waypoints import Waypoints
from mrpbench_core.engine.execution.routes import Router
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.planning.plan import Path, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import Level, World

PERIOD = 0.05
"""Control period, seconds."""
AROUND = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
APART = 10
"""Cells between the corners of two rings."""


@attrs.frozen(kw_only=True)
class RingsResult:
    """What happened to rings of four robots."""

    rotations: int
    """Rotations that all four robots completed, summed over rings."""
    contacts: int
    """Control periods and pairs of robots that touched."""
    gap: float
    """Smallest distance in metres between the discs of two robots of a ring."""


def ring_problem(cell: float, rings: int, turns: int, seed: int) -> tuple[Fleet, Problem, Plan]:
    """Fleet, problem and plan of rings that rotate `turns` times on cells of a side in metres, in drawn directions."""
    random = np.random.default_rng(seed)
    model = load_robot("turtlebot3_burger")
    base = 4 * np.arange(rings)[:, None]
    corners = np.concatenate([AROUND + (APART * ring, 0) for ring in range(rings)]) * cell
    step = np.arange(4)
    both = [np.stack([base + step, base + (step + way) % 4], axis=-1) for way in (1, 3)]
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
        at = np.cumsum([0, *np.where(ways, 3, 1)]) % 4
        for robot_at in range(4):
            vertex = (at + robot_at) % 4
            paths.append(Path(edge=8 * ring + 4 * ways + vertex[:-1], enter=time, leave=time + 1))
            goals.append((((4 * ring + int(vertex[-1])),),))
    count = 4 * rings
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
    navigator: Waypoints | None = None,
    limit: float = 60.0,
) -> RingsResult:
    """Execute a plan of `ring_problem`, from drawn yaws, for at most `limit` simulated seconds a turn."""
    fleet, problem, plan = ring_problem(cell, rings, turns, seed)
    count = len(fleet)
    world = World(name="empty", levels=(Level(name="L1"),))
    yaw = np.random.default_rng(seed + 1).uniform(-np.pi, np.pi, count)
    pose = np.column_stack([problem.roadmap.position[problem.start], yaw])
    routes = Router(problem, np.full(count, np.nan), np.full(len(problem.roadmap.edges), np.inf))(plan)
    session = dispatcher.start(problem, plan)
    driver = (navigator or Waypoints()).start(fleet, world, routes, controller, PERIOD, seed)
    reached = cleared = np.zeros(count, "i4")
    contacts, gap = 0, np.inf
    ring = np.arange(count).reshape(rings, 4)
    one, other = (ring[:, list(index)].ravel() for index in zip(*combinations(range(4), 2), strict=True))
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
            gap = min(gap, float((apart - fleet.radii[one] - fleet.radii[other]).min()))
    return RingsResult(rotations=int(reached.reshape(-1, 4).min(axis=1).sum()), contacts=contacts, gap=gap)
