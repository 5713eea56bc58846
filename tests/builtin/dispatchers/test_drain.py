"""Plans drain under random delays, without deadlock and without two robots in one place.

The floor below moves robots along what is released, each as slowly as chance will have it, and watches them by rules of
its own: who enters a vertex that another has not cleared must be part of a ring that starts together, robots come to
each vertex in the plan's order, and footprints never overlap.
"""

from collections import defaultdict
from importlib.metadata import entry_points
from itertools import combinations, pairwise

import attrs
import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.engine.commitments import commitments
from mrpbench_core.model.plan import Budget, Path, Plan
from mrpbench_core.model.problem import Feature, Rules, features_of

SEEDS = st.integers(0, 2**32 - 1)


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


def drain(make, session, floor, replans=None):
    """Run until everybody has arrived; `replans` gives, by step, functions of what is released to problem and plan."""
    released = np.zeros(len(floor.reached), int)
    replans = dict(replans or {})
    revision = 0
    for now in range(20_000):
        orders = session.update(float(now), make.view(floor.reached, floor.cleared, revision))
        assert (orders.released >= released).all(), "took back what it had released"
        released = orders.released
        alive = floor.step(now, released)
        if now in replans:
            problem, plan = replans.pop(now)(released)
            if accepted(problem, plan, lambda *new: session.adopt(*new) or True):
                floor.adopt(problem, plan)
                revision += 1
        elif floor.done and not replans:
            return
        elif not alive and not replans:
            again = session.update(float(now), make.view(floor.reached, floor.cleared, revision)).released
            assert (again > released).any(), "deadlock"
    raise AssertionError("not done in 20,000 steps")


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
            assert None not in guilty
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


def accepted(problem, plan, take):
    """What `take` makes of a plan, or None where it refuses it for a cycle that is there indeed."""
    try:
        return take(problem, plan)
    except DispatchError as refusal:
        assert "wait for one another" in str(refusal) or "in a ring at once" in str(refusal), refusal  # noqa: PT017
        assert cycle_in(problem, plan)
        return None


def cycle_in(problem, plan):
    """Tell, by a search of its own, whether moves wait for one another: at each vertex, who comes for who went."""
    after = defaultdict(set)
    visits = defaultdict(list)  # of each vertex: (arrival, move in, move out)
    for robot, path in enumerate(plan.paths):
        moves = [(robot, segment) for segment in np.flatnonzero(path.edge >= 0).tolist()]
        arrivals = [-1, *(int(path.leave[segment]) for _, segment in moves)]
        vertices = [int(problem.start[robot]), *(int(problem.roadmap.edges[path.edge[at], 1]) for _, at in moves)]
        for vertex, *visit in zip(vertices, arrivals, [None, *moves], [*moves, None], strict=True):
            visits[vertex].append(visit)
        for one, other in pairwise(moves):
            after[one].add(other)
    for here in visits.values():
        for (_, _, out), (_, into, _) in combinations(sorted(here, key=lambda visit: visit[0]), 2):
            if out is not None and into is not None and out[0] != into[0]:
                after[out].add(into)
    nodes = set(after) | {node for those in after.values() for node in those}
    while free := nodes - {node for one in nodes for node in after[one]}:
        nodes -= free
    return bool(nodes)


@settings(deadline=None, max_examples=60)
@given(SEEDS)
def test_plans_of_chance_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)
    session = accepted(problem, plan, Adg().start)
    event(f"refused: {session is None}")
    if session is not None:
        floor = Floor(problem, plan, random)
        drain(make, session, floor)
        event(f"rings: {floor.rings > 0}")


@settings(deadline=None, max_examples=80)
@given(SEEDS)
def test_plans_that_change_on_the_way_drain(make, seed):
    random = np.random.default_rng(seed)
    problem, plan = draw_plan(make, random)

    def replan(released):
        now, due = floor.late, floor.late + int(random.integers(0, 40))
        floor.late = due
        ready = now + random.integers(0, 5, len(problem))
        prefixes = commitments(problem, session.plan, released, floor.reached, ready, due)
        committed = attrs.evolve(problem, commitments=prefixes)
        assert check_plan(committed, Plan(paths=prefixes)).valid, "what was released conflicts once it is retimed"
        return committed, wander(committed, random, list(prefixes), ticks=5)

    problem = attrs.evolve(problem, rules=attrs.evolve(problem.rules, at_goal="stay"))
    if check_plan(problem, plan).valid and (session := accepted(problem, plan, Adg().start)) is not None:
        floor = Floor(problem, plan, random)
        floor.late = int(random.integers(0, 40))
        drain(make, session, floor, {int(step): replan for step in random.integers(0, 60, 3)})


@settings(deadline=None, max_examples=40)
@given(SEEDS)
@pytest.mark.parametrize("name", ["example", "prioritized", "cbs"])
def test_plans_of_planners_drain(make, name, seed):
    found = {point.name: point for point in entry_points(group="mrpbench.planners")}
    if name not in found:
        pytest.skip(f"no planner {name} is installed")
    try:
        planner = found[name].load()()
    except ImportError as error:
        pytest.skip(f"planner {name} cannot be imported: {error}")
    random = np.random.default_rng(seed)
    problem = draw_problem(make, random, draw_roadmap(make, random))
    if name == "cbs" and len(problem) > 5:
        return
    goals = random.permutation(len(problem.roadmap.position))[: len(problem)]
    problem = attrs.evolve(problem, goals=tuple(((int(goal),),) for goal in goals), rules=Rules())
    for features in (features_of(problem), features_of(problem) | {Feature.FOOTPRINTS}):
        asked = attrs.evolve(problem, features=features)
        if planner.skip(asked) is None:
            result = planner.plan(asked, Budget(wall_s=0.2, memory_bytes=1 << 30))
            event(str(result.status))
            if result.plan is not None and (session := accepted(asked, result.plan, Adg().start)) is not None:
                drain(make, session, Floor(asked, result.plan, random))
