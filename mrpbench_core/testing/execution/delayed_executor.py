"""Robots that drive the released parts of their paths on the roadmap, each with random delays."""

from collections import defaultdict
from itertools import combinations

import numpy as np

from mrpbench_core.model.common.arrays import Bool, Float, Int32
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Feature, Problem

CLEARED_AT = 0.4
"""Share of a move after which a robot has cleared the vertex that it comes from."""
BEGUN = 1e-9


class DelayedExecutor:
    """Executes plans without metres or seconds, and checks by independent rules that robots keep apart.

    A robot holds the vertex that it comes from until it has cleared it, and the vertex that it goes to. Only robots of
    a ring that start together may enter vertices that others have not cleared. Footprints do not overlap.
    """

    def __init__(self, problem: Problem, plan: Plan, random: np.random.Generator | None = None) -> None:
        """Put robots at their starts; without `random`, every move takes one step and nothing is late."""
        robots = len(problem)
        self._random = np.random.default_rng(0) if random is None else random
        self._delays = random is not None
        self.reached = np.zeros(robots, np.int32)
        self.cleared = np.zeros(robots, np.int32)
        self._progress = np.zeros(robots)  # share of the move that a robot is on; 0 = it stands
        self._pace = self._random.uniform(0.02, 0.6, robots)
        late = self._random.random(robots) < 0.3
        self._stuck_until = np.where(late & self._delays, self._random.integers(0, 150, robots), 0)
        self._lag = self._random.integers(0, 4, robots) if self._delays else np.zeros(robots, int)
        self._ring: list[tuple[int, ...]] = [(robot,) for robot in range(robots)]
        self.rings = 0
        """Rings of several robots that have started."""
        self.fault: str | None = None
        """The first violation, as a sentence."""
        self.reordered = False
        """True after robots have reached a vertex in another order than in the plan."""
        self._entered: dict[int, list[int]] = defaultdict(list)
        for robot, start in enumerate(problem.start.tolist()):
            self._entered[start].append(robot)
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan) -> None:
        """Continue with a new plan that begins with the released part of the old one."""
        self.problem, self.plan = problem, plan
        self._footprints = Feature.FOOTPRINTS in problem.features
        self.routes = [
            path.vertices(problem.roadmap, start).tolist()
            for path, start in zip(plan.paths, problem.start.tolist(), strict=True)
        ]
        visits: dict[int, list[tuple[int, int]]] = defaultdict(list)
        for robot, path in enumerate(plan.paths):
            visits[self.routes[robot][0]].append((-1, robot))
            for segment in np.flatnonzero(path.edge >= 0).tolist():
                visits[self.routes[robot][segment + 1]].append((int(path.leave[segment]), robot))
        self._planned = {vertex: [robot for _, robot in sorted(here)] for vertex, here in visits.items()}

    @property
    def done(self) -> bool:
        """True when all robots have reached the ends of their paths."""
        return all(self.reached[robot] == len(path) for robot, path in enumerate(self.plan.paths))

    @property
    def moving(self) -> Bool:
        """bool[n]: the robots that are on an edge."""
        return self._progress > 0

    def view(self, revision: int = 0, granted: tuple[tuple[int, str], ...] = ()) -> FleetView:
        """Return the fleet as a dispatcher sees it."""
        tails = [route[at] for route, at in zip(self.routes, self.reached, strict=True)]
        return FleetView(
            revision=revision,
            reached=self.reached.copy(),
            cleared=self.cleared.copy(),
            pose=np.column_stack([self._places(), np.zeros(len(tails))]),
            level=self.problem.roadmap.level[np.array(tails, int)],
            mode=np.where(self.moving, Mode.FOLLOWING, Mode.WAITING),
            granted=granted,
        )

    def gone(self, robot: int) -> bool:
        """Tell whether a robot has disappeared at its goal."""
        return self.problem.rules.at_goal == "disappear" and self.reached[robot] == len(self.plan.paths[robot])

    def step(self, now: int, released: Int32) -> bool:
        """Move all robots a little; return whether anything can still happen without new orders."""
        self._end_waits(released)
        for robot in self._random.permutation(len(self.routes)).tolist():
            if now >= self._stuck_until[robot] and self._wants(robot, released) is not None:
                self._set_out(robot, released)
        moving = np.flatnonzero(self.moving).tolist()
        for robot in moving:
            if robot == self._ring[robot][0]:  # the robots of a ring move in step
                share = self._pace[robot] * self._random.random() if self._delays else 1.0
                self._progress[list(self._ring[robot])] = min(1.0, self._progress[robot] + share)
        self._watch()
        arrived = self._progress >= 1
        self.reached += arrived
        self._progress[arrived] = 0.0
        self._end_waits(released)
        return self._clear() or bool(moving) or bool((now < self._stuck_until).any())

    def _violate(self, fault: str) -> None:
        self.fault = self.fault or fault

    def _wants(self, robot: int, released: Int32) -> int | None:
        """The vertex to which a standing robot may go now, or None."""
        if self.reached[robot] >= released[robot] or self._progress[robot] > 0:
            return None
        return int(self.routes[robot][self.reached[robot] + 1])

    def _holders(self, vertex: int, but: int) -> list[int]:
        """Robots that stand at a vertex, go to it, or have not cleared it."""
        holders = []
        for robot, route in enumerate(self.routes):
            at = self.reached[robot]
            comes = self._progress[robot] > 0 and route[at + 1] == vertex
            if robot != but and not self.gone(robot) and (comes or vertex in route[self.cleared[robot] : at + 1]):
                holders.append(robot)
        return holders

    def _set_out(self, robot: int, released: Int32) -> None:
        """Begin a move, and the moves of the others of a ring if the robot is part of one."""
        ring = self._find_ring(robot, released)
        self.rings += len(ring) > 1
        for member in ring:
            head = self._wants(member, released)
            assert head is not None
            self._entered[head].append(member)
            self.reordered |= self._entered[head] != self._planned[head][: len(self._entered[head])]
            self._ring[member] = tuple(ring)
            self._progress[member] = BEGUN

    def _find_ring(self, robot: int, released: Int32) -> list[int]:
        """The robots that have to start together with a robot, itself first."""
        ring = [robot]
        while not self._footprints:
            head = self._wants(ring[-1], released)
            assert head is not None
            holders = self._holders(head, but=ring[-1])
            if not holders:
                return ring
            if len(holders) > 1 or holders[0] in ring[1:] or self._wants(holders[0], released) is None:
                self._violate(f"robot {ring[-1]} is sent to vertex {head}, which robot {holders[0]} has not cleared")
                return [robot]
            if holders[0] == robot:
                return ring
            ring.append(holders[0])
        return ring

    def _end_waits(self, released: Int32) -> None:
        for robot, path in enumerate(self.plan.paths):
            while self._progress[robot] == 0 and self.reached[robot] < released[robot]:
                if path.edge[self.reached[robot]] >= 0:
                    break
                self.reached[robot] += 1

    def _clear(self) -> bool:
        """Clear vertices that robots have left: some steps after they arrive at the latest, those of a ring at once."""
        pending = False
        for robot, route in enumerate(self.routes):
            left = int(self.reached[robot])
            in_ring = len(self._ring[robot]) > 1
            if self._progress[robot] > CLEARED_AT and not in_ring:
                left += 1
            else:
                while left > 0 and route[left] == route[left - 1]:
                    left -= 1  # the robot still waits there
            if left > self.cleared[robot]:
                pending = True
                if in_ring or self._random.random() * (1 + self._lag[robot]) < 1:
                    self.cleared[robot] = left
        return pending

    def _ends(self) -> list[tuple[int, int]]:
        """The vertices between which each robot is; equal if the robot stands."""
        moves = zip(self.routes, self.reached.tolist(), self.moving.tolist(), strict=True)
        return [(route[at], route[at + going]) for route, at, going in moves]

    def _places(self) -> Float:
        """The positions f8[n,2] of the robots."""
        ends = np.array(self._ends(), int).reshape(-1, 2)
        tail, head = (self.problem.roadmap.position[ends[:, side]] for side in (0, 1))
        places: Float = tail + self._progress[:, None] * (head - tail)
        return places

    def _watch(self) -> None:
        """Look for robots that follow where that is forbidden, or whose footprints overlap."""
        radius, moving, ends, place = self.problem.radius, self.moving, self._ends(), self._places()
        for one, other in combinations([robot for robot in range(len(ends)) if not self.gone(robot)], 2):
            (a, b), (c, d) = ends[one], ends[other]
            follows = self.problem.rules.following == "forbidden" and moving[one] and moving[other]
            if follows and (b == c or a == d):
                self._violate(f"robots {one} and {other} follow one another, which the rules forbid")
            if self._footprints or (moving[one] and other in self._ring[one]):
                apart = float(np.hypot(*(place[one] - place[other])))
                if apart < radius[one] + radius[other] - 1e-6:
                    self._violate(f"the footprints of robots {one} and {other} overlap")
