"""Robots that do what is released to them as slowly as chance will have it, and plans that no planner has made."""

from collections import defaultdict
from itertools import combinations

import attrs
import numpy as np

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.plan import Path, Plan
from mrpbench_core.model.problem import Feature, Rules


class Floor:
    """Robots that do what is released to them, sooner or later."""

    def __init__(self, problem, plan, random):
        robots = len(problem)
        self.random = random
        self.reached = np.zeros(robots, int)
        self.cleared = np.zeros(robots, int)
        self.progress = np.zeros(robots)  # along the move that a robot is on; 0 = it stands
        self.pace = random.uniform(0.02, 0.6, robots)
        self.stuck_until = np.where(random.random(robots) < 0.3, random.integers(0, 150, robots), 0)
        self.lag = random.integers(0, 4, robots)
        self.convoy = [(robot,) for robot in range(robots)]
        self.rings = 0
        self.entered = defaultdict(list)
        for robot, start in enumerate(problem.start.tolist()):
            self.entered[start].append(robot)
        self.adopt(problem, plan)

    def adopt(self, problem, plan):
        self.problem, self.plan = problem, plan
        self.footprints = Feature.FOOTPRINTS in problem.features
        self.routes = [
            path.vertices(problem.roadmap, start).tolist()
            for path, start in zip(plan.paths, problem.start.tolist(), strict=True)
        ]
        visits = defaultdict(list)
        for robot, path in enumerate(plan.paths):
            visits[self.routes[robot][0]].append((-1, robot))
            for segment in np.flatnonzero(path.edge >= 0).tolist():
                visits[self.routes[robot][segment + 1]].append((int(path.leave[segment]), robot))
        self.planned = {vertex: [robot for _, robot in sorted(here)] for vertex, here in visits.items()}

    @property
    def done(self):
        return all(self.reached[robot] == len(path) for robot, path in enumerate(self.plan.paths))

    def gone(self, robot):
        """Tell whether a robot has disappeared at its goal."""
        return self.problem.rules.at_goal == "disappear" and self.reached[robot] == len(self.plan.paths[robot])

    def wants(self, robot, released):
        """The vertex to which a standing robot may go now, or None."""
        if self.reached[robot] == released[robot] or self.progress[robot] > 0:
            return None
        return self.routes[robot][self.reached[robot] + 1]

    def holders(self, vertex, but):
        """Robots that stand at a vertex, come to it, or have not cleared it."""
        for robot, route in enumerate(self.routes):
            at = self.reached[robot]
            comes = self.progress[robot] > 0 and route[at + 1] == vertex
            if robot != but and not self.gone(robot) and (comes or vertex in route[self.cleared[robot] : at + 1]):
                yield robot

    def set_out(self, robot, released):
        """Begin a move, and the others of a ring if it is part of one."""
        ring = [robot]
        while not self.footprints and (holders := list(self.holders(self.wants(ring[-1], released), but=ring[-1]))):
            assert len(holders) == 1, "two robots hold one vertex"
            assert self.wants(holders[0], released) is not None, "sent to a vertex that another has not cleared"
            if holders[0] == robot:
                break
            assert holders[0] not in ring, "sent to a vertex that another has not cleared"
            ring.append(holders[0])
        self.rings += len(ring) > 1
        for member in ring:
            head = self.wants(member, released)
            self.entered[head].append(member)
            assert self.entered[head] == self.planned[head][: len(self.entered[head])], "order changed"
        for member in ring:
            self.convoy[member] = tuple(ring)
            self.progress[member] = 1e-9

    def step(self, now, released):
        """Move everybody a little; return whether anything can still happen without new orders."""
        self.settle(released)
        for robot in self.random.permutation(len(self.routes)).tolist():
            if now >= self.stuck_until[robot] and self.wants(robot, released) is not None:
                self.set_out(robot, released)
        moving = np.flatnonzero(self.progress > 0).tolist()
        for robot in moving:
            if robot == self.convoy[robot][0]:  # a ring moves in step
                share = self.progress[robot] + self.pace[robot] * self.random.random()
                self.progress[list(self.convoy[robot])] = min(1.0, share)
        self.watch()
        arrived = self.progress >= 1
        self.reached += arrived
        self.progress[arrived] = 0.0
        self.settle(released)
        return self.clear() or bool(moving) or bool((now < self.stuck_until).any())

    def settle(self, released):
        """End the waits that are released."""
        for robot, path in enumerate(self.plan.paths):
            while self.progress[robot] == 0 and self.reached[robot] < released[robot]:
                if path.edge[self.reached[robot]] >= 0:
                    break
                self.reached[robot] += 1

    def clear(self):
        """Clear what was left: at latest some steps after a robot has arrived, those of a ring at once."""
        pending = False
        for robot, route in enumerate(self.routes):
            left = self.reached[robot]
            in_ring = len(self.convoy[robot]) > 1
            if self.progress[robot] > 0.4 and not in_ring:
                left += 1
            else:
                while left > 0 and route[left] == route[left - 1]:
                    left -= 1  # it waits there still
            if left > self.cleared[robot]:
                pending = True
                if in_ring or self.random.random() * (1 + self.lag[robot]) < 1:
                    self.cleared[robot] = left
        return pending

    def watch(self):
        """Look where everybody is."""
        position, radius = self.problem.roadmap.position, self.problem.radius
        moving = self.progress > 0
        ends = [
            (route[at], route[at + going]) for route, at, going in zip(self.routes, self.reached, moving, strict=True)
        ]
        place = [
            position[tail] + share * (position[head] - position[tail])
            for (tail, head), share in zip(ends, self.progress, strict=True)
        ]
        for one, other in combinations([robot for robot in range(len(ends)) if not self.gone(robot)], 2):
            (a, b), (c, d) = ends[one], ends[other]
            if self.problem.rules.following == "forbidden" and moving[one] and moving[other]:
                assert b != c, "one follows the other"
                assert a != d, "one follows the other"
            if self.footprints or (moving[one] and other in self.convoy[one]):
                apart = float(np.hypot(*(place[one] - place[other])))
                assert apart >= radius[one] + radius[other] - 1e-6, "footprints overlap"


def draw_roadmap(make, random):
    """A grid, or one with lanes bent, missing, crossing, and of different lengths, or a weave."""
    rows, columns = (int(size) for size in random.integers(2, 5, 2))
    kind = random.choice(["grid", "bent", "weave"])
    if kind == "weave":
        return draw_weave(make, random, rows, columns)
    grid = make.grid(rows, columns)
    if kind == "grid":
        return grid
    corners = [v for v in range((rows - 1) * columns) if (v + 1) % columns]
    lanes = grid.edges[::2].tolist()
    lanes += [pair for v in corners for pair in ((v, v + columns + 1), (v + 1, v + columns)) if random.random() < 0.3]
    lanes = [lane for lane in lanes if random.random() < 0.9]
    bent = grid.position + random.uniform(-0.2, 0.2, grid.position.shape)
    return make.roadmap(bent, lanes, duration=random.integers(1, 6, len(lanes)))


def draw_weave(make, random, rows, columns):
    """Long lanes that cross one another between their ends, each end joined to that of the next lane beside it."""
    across = [((-1, y), (columns, y)) for y in range(rows)]
    along = [((x, -1), (x, rows)) for x in range(columns)]
    points = [point for lane in across + along for point in lane]
    lanes = [(v, v + 1) for v in range(0, len(points), 2)]
    lanes += [(v, v + 2) for v in range(len(points) - 2) if v not in (2 * rows - 2, 2 * rows - 1)]
    return make.roadmap(points, lanes, duration=random.integers(1, 4, len(lanes)))


def draw_problem(make, random, roadmap):
    """Robots on a roadmap, with rules and footprints drawn too; they may end anywhere."""
    robots = int(random.integers(2, max(3, len(roadmap.position) * random.uniform(0.3, 1.2))))
    starts = random.permutation(len(roadmap.position))[:robots]
    robots = len(starts)
    nowhere = Plan(paths=tuple(make.path(roadmap, [start]) for start in starts))
    problem = attrs.evolve(
        make.problem(roadmap, nowhere, starts),
        radius=random.choice([0.1, 0.2, 0.4], robots),
        goals=((),) * robots,
        rules=Rules(
            following=str(random.choice(["allowed", "allowed", "forbidden"])),
            at_goal=str(random.choice(["stay", "stay", "disappear"])),
        ),
        features=frozenset({Feature.FOOTPRINTS}) if random.random() < 0.4 else frozenset(),
    )
    return problem if check_plan(problem, nowhere).valid else attrs.evolve(problem, radius=np.full(robots, 0.1))


def wander(problem, random, paths, ticks):
    """Lengthen paths by a conflict-free random walk: moves that chance proposes are dropped while they conflict."""
    edges = problem.roadmap.edges
    begin = max((int(path.leave[-1]) for path in paths if len(path)), default=0)
    for now in range(begin, begin + ticks):
        idle = [robot for robot, path in enumerate(paths) if not len(path) or path.leave[-1] <= now]
        at = {robot: int(paths[robot].vertices(problem.roadmap, problem.start[robot])[-1]) for robot in idle}
        moves = {
            robot: int(random.choice(ways))
            for robot, vertex in at.items()
            if len(ways := np.flatnonzero(edges[:, 0] == vertex)) and random.random() < 0.8
        }
        ring = draw_ring(random, edges, at)
        moves = ring if ring and random.random() < 0.5 else moves | ring
        while True:
            tried = [moved(problem, robot, path, moves.get(robot), now) for robot, path in enumerate(paths)]
            conflicts = check_plan(problem, Plan(paths=tuple(tried))).conflicts
            guilty = {next((robot for robot in conflict.robots if robot in moves), None) for conflict in conflicts}
            if None in guilty:  # of three robots in a resource a conflict names two
                assert problem.roadmap.resources
                assert moves
                guilty = set(moves)
            if not guilty:
                break
            for robot in guilty:
                del moves[robot]
        paths = tried
    return Plan(paths=tuple(paths))


def draw_ring(random, edges, at):
    """Moves of robots, each to where the next one stands, if chance finds a ring of them."""
    robot_at = {vertex: robot for robot, vertex in at.items()}
    chain, taken = [int(random.choice(list(robot_at)))] if robot_at else [], []
    while chain:
        ways = [
            int(edge)
            for edge in np.flatnonzero(edges[:, 0] == chain[-1])
            if int(edges[edge, 1]) in robot_at and int(edges[edge, 1]) not in chain[len(chain) > 2 :]
        ]
        if not ways:
            break
        taken.append(int(random.choice(ways)))
        if edges[taken[-1], 1] == chain[0]:
            return {robot_at[vertex]: edge for vertex, edge in zip(chain, taken, strict=True)}
        chain.append(int(edges[taken[-1], 1]))
    return {}


def moved(problem, robot, path, edge, now):
    """A path with a move from tick `now`, and a wait before it if need be."""
    if edge is None:
        return path
    last = int(path.leave[-1]) if len(path) else 0
    waits = [-1] * (now > last)
    return Path(
        edge=[*path.edge, *waits, edge],
        enter=[*path.enter, *([last] * len(waits)), now],
        leave=[*path.leave, *([now] * len(waits)), now + int(problem.duration(robot)[edge])],
    )


def squeeze(problem, random, plan, tries=40):
    """Take time out of waits where the plan stays sound: robots then come close upon one another."""
    for _ in range(tries):
        robot = int(random.integers(len(plan.paths)))
        path = plan.paths[robot]
        waits = np.flatnonzero((path.edge < 0) & (path.leave > path.enter))
        if len(waits):
            segment = random.choice(waits)
            ticks = int(random.integers(1, path.leave[segment] - path.enter[segment] + 1))
            at = np.arange(len(path))
            shorter = Path(
                edge=path.edge, enter=path.enter - ticks * (at > segment), leave=path.leave - ticks * (at >= segment)
            )
            changed = Plan(paths=(*plan.paths[:robot], shorter, *plan.paths[robot + 1 :]))
            plan = changed if check_plan(problem, changed).valid else plan
    return plan


def draw_plan(make, random):
    """A problem and a sound plan that no planner has made."""
    problem = draw_problem(make, random, draw_roadmap(make, random))
    paths = [make.path(problem.roadmap, [start]) for start in problem.start]
    return problem, squeeze(problem, random, wander(problem, random, paths, ticks=8))
