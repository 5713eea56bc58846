"""Robots that drive the released parts of their paths through doors and lifts, with the engine's facility manager."""

import numpy as np

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.engine.execution.facility_manager import FacilityManager
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.orders import FleetView, Orders
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.world import World

PERIOD = 0.1
"""Control period, seconds."""
SPEED = 0.2
"""Metres per second."""


class FacilityExecutor:
    """One execution without navigator and simulator: robots drive along their lanes, and stop at random."""

    def __init__(self, world: World, problem: Problem, plan: Plan, random: np.random.Generator) -> None:
        self.problem, self.plan, self.random = problem, plan, random
        self.facility_manager = FacilityManager(world, problem, plan)
        self.facilities = self.facility_manager.facilities
        self.session = Adg().start(problem, plan)
        self.routes = [
            path.vertices(problem.roadmap, start)
            for path, start in zip(plan.paths, problem.start.tolist(), strict=True)
        ]
        robots = len(problem)
        self.reached, self.released = np.zeros(robots, np.int32), np.zeros(robots, np.int32)
        self.driven = np.zeros(robots)
        self.level = problem.roadmap.level[problem.start].copy()
        self.doing = self.facilities.initial_state()
        self.granted: tuple[tuple[int, str], ...] = ()
        self.waited = np.zeros(robots, int)
        self.orders = Orders(released=self.released)

    @property
    def pose(self) -> Float:
        """Poses f8[n,3]."""
        position = self.problem.roadmap.position
        found = np.zeros((len(self.routes), 3))
        for robot, (route, at) in enumerate(zip(self.routes, self.reached.tolist(), strict=True)):
            start, end = position[route[at]], position[route[min(at + 1, len(route) - 1)]]
            length = np.hypot(*(end - start))
            found[robot, :2] = start + (end - start) * (min(self.driven[robot] / length, 1.0) if length > 0 else 0.0)
        return found

    @property
    def done(self) -> bool:
        """True when all robots have reached the ends of their paths."""
        return all(at == len(route) - 1 for at, route in zip(self.reached.tolist(), self.routes, strict=True))

    def gap(self) -> Float:
        """Metres between each robot's disc and the nearest leaf of its level."""
        gaps = np.full(len(self.routes), np.inf)
        for robot, (x, y, _) in enumerate(self.pose.tolist()):
            outline = self.facilities.outlines(self.doing, int(self.level[robot]))
            distance = point_segment_distance(np.array([[x, y]]), outline[:, :2], outline[:, 2:])
            gaps[robot] = distance.min(initial=np.inf) - self.problem.radius[robot]
        return gaps

    def step(self) -> None:
        """Let one control period pass."""
        robots = len(self.routes)
        state = State(
            pose=self.pose,
            twist=np.zeros((robots, 2)),
            level=self.level,
            contacts=np.empty((0, 2), np.int32),
            facilities=self.doing,
        )
        view = FleetView(
            revision=0,
            reached=self.reached,
            cleared=self.reached + (self.driven > 2 * self.problem.radius),
            pose=self.pose,
            level=self.level,
            mode=np.full(robots, Mode.FOLLOWING, np.uint8),
        )
        view = self.facility_manager.with_grants(view, state)
        self.granted = view.granted
        self.orders = self.session.update(0.0, view)
        self.facility_manager.assign(0.0, self.orders.requests)
        self.released = self.orders.released
        waits = self.facility_manager.waits_for() >= 0
        self.waited = np.where(waits, self.waited + 1, 0)
        commands = self.facility_manager.commands(self.reached, self.released, state)
        doing = self.facilities.advance(
            self.doing, commands, PERIOD, self.pose, self.level, np.asarray(self.problem.radius)
        )
        self.level = self.facilities.carry(self.doing, doing, self.pose, self.level)
        self.doing = doing
        for robot in range(robots):
            self._drive(robot)

    def _drive(self, robot: int) -> None:
        at = int(self.reached[robot])
        if at >= self.released[robot] or self.random.random() < 0.2:
            return
        roadmap, route = self.problem.roadmap, self.routes[robot]
        if route[at] == route[at + 1]:  # a wait
            self.reached[robot] += 1
            return
        start, end = roadmap.position[route[at]], roadmap.position[route[at + 1]]
        self.driven[robot] += SPEED * PERIOD
        arrived = self.driven[robot] >= np.hypot(*(end - start)) - 1e-9
        if arrived and self.level[robot] == roadmap.level[route[at + 1]]:
            self.reached[robot] += 1
            self.driven[robot] = 0.0
