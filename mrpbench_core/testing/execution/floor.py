"""Robots on a roadmap without metres: they do what is released to them, each as late as chance will have it."""

import numpy as np

from mrpbench_core.model.execution import FleetView, Mode
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import Problem
from mrpbench_core.testing.faults import require


class Floor:
    """A robot on its way holds the vertex it comes from, until it has cleared it, and the one it goes to."""

    def __init__(self, problem: Problem, plan: Plan, seed: int, delays: bool) -> None:
        starts = zip(plan.paths, problem.start.tolist(), strict=True)
        self.routes = [path.vertices(problem.roadmap, start).tolist() for path, start in starts]
        self.edges = [path.edge.tolist() for path in plan.paths]
        self.position = problem.roadmap.position
        robots = len(problem)
        self.reached = np.zeros(robots, np.int32)
        self.left = np.zeros(robots, int)
        """steps until a robot arrives; 0 = it stands"""
        self.random = np.random.default_rng(seed)
        self.delays = delays
        self.met: tuple[int, int] | None = None
        """the first two robots that held one vertex"""

    @property
    def done(self) -> bool:
        """Everybody has arrived."""
        return all(self.reached[robot] == len(edges) for robot, edges in enumerate(self.edges))

    def view(self) -> FleetView:
        """What a dispatcher sees."""
        robots = len(self.routes)
        at = [route[done] for route, done in zip(self.routes, self.reached, strict=True)]
        pose = np.column_stack([self.position[at], np.zeros(robots)])
        mode = np.where(self.left > 0, Mode.FOLLOWING, Mode.WAITING)
        return FleetView(
            revision=0,
            reached=self.reached,
            cleared=self._cleared(),
            pose=pose,
            level=np.zeros(robots, np.int16),
            mode=mode,
        )

    def step(self, released: np.ndarray) -> bool:
        """Let each robot go on; return whether any could."""
        active = False
        for robot in range(len(self.routes)):
            if self.left[robot] == 0:
                self._wait(robot, released[robot])
                if self.reached[robot] < released[robot]:
                    self.left[robot] = self.random.integers(1, 30) if self.delays else 1
            if self.left[robot] > 0:
                active = True
        self._watch()
        for robot in np.flatnonzero(self.left).tolist():
            self.left[robot] -= 1
            if self.left[robot] == 0:
                self.reached[robot] += 1
                self._wait(robot, released[robot])
        return active

    def _wait(self, robot: int, released: int) -> None:
        """End the waits that are released."""
        while self.reached[robot] < released and self.edges[robot][self.reached[robot]] < 0:
            self.reached[robot] += 1

    def _cleared(self) -> np.ndarray:
        """A robot that stands has cleared all before the visit it is on."""
        cleared = self.reached.copy()
        for robot, route in enumerate(self.routes):
            while cleared[robot] > 0 and route[cleared[robot]] == route[cleared[robot] - 1]:
                cleared[robot] -= 1
        return cleared

    def _watch(self) -> None:
        holder: dict[int, int] = {}
        for robot, route in enumerate(self.routes):
            at = int(self.reached[robot])
            for vertex in {route[at], route[at + (self.left[robot] > 0)]}:
                other = holder.setdefault(vertex, robot)
                if other != robot and self.met is None:
                    self.met = (other, robot)


def requires_released(released: np.ndarray, before: np.ndarray, plan: Plan) -> None:
    """Require that an order releases what there is, and takes nothing back."""
    lengths = np.array([len(path) for path in plan.paths])
    require(released.shape == before.shape, f"released has shape {released.shape} for {len(before)} robots")
    require(
        (released >= 0).all() and (released <= lengths).all(), f"releases {released.tolist()} of {lengths.tolist()}"
    )
    require((released >= before).all(), f"takes back what it had released: {before.tolist()}, then {released.tolist()}")
