"""A building with a door and a lift, and robots that drive through it as they please within what is released."""

import attrs
import numpy as np

from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.engine.execution.facility_manager import FacilityManager
from mrpbench_core.engine.stages.problem_building import problem_with_features
from mrpbench_core.model.execution import FleetView, Mode, Orders, State
from mrpbench_core.model.geometry import point_segment_distance
from mrpbench_core.model.plan import Path
from mrpbench_core.model.world import Lane, Vertex
from mrpbench_core.testing.fixtures.building import CABIN, DOOR, building
from mrpbench_core.testing.fixtures.room import fleet

PERIOD, SPEED = 0.1, 0.2
PLACES = {
    "corner": (0.5, 0.5),
    "window": (0.5, 2.5),
    "middle": (0.9, 1.5),
    "landing": (2.3, 1.5),
    "cabin": CABIN,
    "shelf": (2.35, 0.4),
}
LANES = [
    ("corner", "middle"),
    ("window", "middle"),
    ("corner", "window"),
    ("middle", "landing"),
    ("landing", "cabin"),
    ("landing", "shelf"),
]


def site(motion="sliding", direction=1):
    """Two levels of the same places; below, a door parts `middle` from `landing`."""
    world = building()
    door = attrs.evolve(DOOR, motion=motion, motion_direction=direction)
    levels = (attrs.evolve(world.levels[0], doors=(door,)), world.levels[1])
    vertices, lanes = [], []
    for level in (0, 1):
        first = len(vertices)
        number = {name: first + index for index, name in enumerate(PLACES)}
        for name, (x, y) in PLACES.items():
            lift = "lift" if name == "cabin" else ""
            vertices.append(Vertex(name=f"{name}_{level}", x=x, y=y, level=level, lift=lift))
        lanes += [Lane(start=number[a], end=number[b]) for a, b in LANES]
    return attrs.evolve(world, levels=levels, vertices=tuple(vertices), lanes=tuple(lanes))


def problem_of(world, starts, goals):
    """The problem of robots that start and end at named places."""
    robots = fleet(len(starts))
    roadmap = Graph().build(world, robots)
    number = {vertex.name: int(roadmap.place[index]) for index, vertex in enumerate(world.vertices)}
    return problem_with_features(
        roadmap, robots, np.array([number[name] for name in starts]), tuple(((number[name],),) for name in goals)
    )


def path(roadmap, start, *route):
    """A path that drives through vertices one after the other."""
    edges, at = [], start
    for vertex in route:
        (found,) = np.flatnonzero((roadmap.edges == (at, vertex)).all(axis=1))
        edges.append(int(found))
        at = vertex
    leave = np.cumsum(roadmap.duration[0, edges])
    return Path(edge=edges, enter=leave - roadmap.duration[0, edges], leave=leave)


class Site:
    """One execution without navigator and simulator: robots keep to their lanes, and stop when chance will have it."""

    def __init__(self, world, problem, plan, random):
        self.problem, self.plan, self.random = problem, plan, random
        self.facility_manager = FacilityManager(world, problem, plan)
        self.facilities = self.facility_manager.facilities
        self.session = Adg().start(problem, plan)
        self.routes = [
            path.vertices(problem.roadmap, start)
            for path, start in zip(plan.paths, problem.start.tolist(), strict=True)
        ]
        robots = len(problem)
        self.reached, self.released = np.zeros(robots, "i4"), np.zeros(robots, "i4")
        self.driven = np.zeros(robots)
        self.level = problem.roadmap.level[problem.start].copy()
        self.doing = self.facilities.initial_state()
        self.waited = np.zeros(robots, int)
        self.orders = Orders(released=self.released)

    @property
    def pose(self):
        """f8[n,3]."""
        position = self.problem.roadmap.position
        found = np.zeros((len(self.routes), 3))
        for robot, (route, at) in enumerate(zip(self.routes, self.reached.tolist(), strict=True)):
            start, end = position[route[at]], position[route[min(at + 1, len(route) - 1)]]
            length = np.hypot(*(end - start))
            found[robot, :2] = start + (end - start) * (min(self.driven[robot] / length, 1.0) if length > 0 else 0.0)
        return found

    @property
    def done(self):
        return all(at == len(route) - 1 for at, route in zip(self.reached.tolist(), self.routes, strict=True))

    def gap(self):
        """Metres between each robot's disc and the nearest leaf of its level."""
        gaps = np.full(len(self.routes), np.inf)
        for robot, (x, y, _) in enumerate(self.pose.tolist()):
            outline = self.facilities.outlines(self.doing, int(self.level[robot]))
            distance = point_segment_distance(np.array([[x, y]]), outline[:, :2], outline[:, 2:])
            gaps[robot] = distance.min(initial=np.inf) - self.problem.radius[robot]
        return gaps

    def step(self):
        """One period."""
        robots = len(self.routes)
        state = State(
            pose=self.pose,
            twist=np.zeros((robots, 2)),
            level=self.level,
            contacts=np.empty((0, 2), "i4"),
            facilities=self.doing,
        )
        view = FleetView(
            revision=0,
            reached=self.reached,
            cleared=self.reached + (self.driven > 2 * self.problem.radius),
            pose=self.pose,
            level=self.level,
            mode=np.full(robots, Mode.FOLLOWING, "u1"),
        )
        view = self.facility_manager.granted(view, state)
        self.granted = view.granted
        self.orders = self.session.update(0.0, view)
        self.facility_manager.take(self.orders)
        self.released = self.orders.released
        waits = self.facility_manager.waiting(robots) >= 0
        self.waited = np.where(waits, self.waited + 1, 0)
        commands = self.facility_manager.commands(self.reached, self.released, state)
        doing = self.facilities.advance(
            self.doing, commands, PERIOD, self.pose, self.level, np.asarray(self.problem.radius)
        )
        self.level = self.facilities.carry(self.doing, doing, self.pose, self.level)
        self.doing = doing
        for robot in range(robots):
            self._drive(robot)

    def _drive(self, robot):
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
