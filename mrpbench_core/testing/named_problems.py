"""Small named problems: some for every planner, and at least one for each feature that a planner may support."""

from collections.abc import Callable

import attrs
import numpy as np

from mrpbench_core.model.planning.problem import Feature, Problem, Rules
from mrpbench_core.model.planning.roadmap import Resource
from mrpbench_core.testing.drawing import grid, problem, unit_path

CROSSING = """
    .  a  .
    b  .  B
    .  A  .
"""
WIDE = """
    .  .  a  .  .
    .  .  .  .  .
    b  .  .  .  B
    .  .  .  .  .
    .  .  A  .  .
"""
BAY = """
    #   #  #  .  #
    aB  .  .  .  bA
"""
CONVOY = "b  a  .  B  A"


def one_way() -> Problem:
    """Only the lower row leads to the right and only the upper row to the left, so that robots drive in a circle."""
    drawn = problem("""
        .   a  B
        bA  .  .
    """)
    row = drawn.roadmap.position[:, 1]
    right = np.diff(drawn.roadmap.position[drawn.roadmap.edges][:, :, 0], axis=1)[:, 0]
    low = row[drawn.roadmap.edges[:, 0]] < 1
    closed = (low & (right < 0)) | (~low & (right > 0))
    return attrs.evolve(drawn, roadmap=attrs.evolve(drawn.roadmap, duration=np.where(closed, -1, 1)[None]))


def slow_lanes(drawing: str, features: frozenset[Feature] = frozenset(), radius: float = 0.1) -> Problem:
    """Steps up and down take three ticks, those from left to right two."""
    drawn = problem(drawing, radius=radius)
    step = np.diff(drawn.roadmap.position[drawn.roadmap.edges], axis=1)[:, 0]
    ticks = np.where(step[:, 1] != 0, 3, np.where(step[:, 0] > 0, 2, 1))
    roadmap = attrs.evolve(drawn.roadmap, duration=ticks[None])
    return problem(drawing, roadmap=roadmap, radius=radius, features=features | {Feature.EDGE_DURATIONS})


def profiles() -> Problem:
    """The second robot may not use the steps of the middle row."""
    drawn = problem(CROSSING)
    middle = (drawn.roadmap.position[drawn.roadmap.edges][:, :, 1] == 1.5).all(axis=1)
    two = attrs.evolve(drawn.roadmap, duration=np.stack([np.ones(len(middle)), np.where(middle, -1, 1)]))
    return problem(CROSSING, roadmap=two, profile=[0, 1])


def commitments() -> Problem:
    """The first robot has begun its path, the second cannot move for three ticks."""
    drawn = problem(CROSSING)
    down = edge_between(drawn, (1.5, 2.5), (1.5, 1.5))
    return problem(CROSSING, ready=[0, 3], commitments=(unit_path([down]), unit_path([])))


def since() -> Problem:
    """The path of the first robot begins in tick 2, when the second one has been driving for long."""
    drawn = problem(CROSSING)
    down, right = edge_between(drawn, (1.5, 2.5), (1.5, 1.5)), edge_between(drawn, (0.5, 1.5), (1.5, 1.5))
    late = attrs.evolve(unit_path([down]), enter=np.array([2]), leave=np.array([3]))
    begun = problem(CROSSING, commitments=(late, unit_path([right])))
    return attrs.evolve(begun, since=np.array([2, 0]), features=begun.features | {Feature.SINCE})


def goal_sequences() -> Problem:
    """The robot must visit the left end before its goal."""
    drawn = problem(". a . A")
    return problem(". a . A", goals=(((0,), drawn.goals[0][0]),))


def shared_goal() -> Problem:
    """Both robots are on their way to the right end; within the horizon one of them can be there."""
    drawn = problem("a . bB . A", horizon=4)
    goal = drawn.goals[0]
    return problem("a . bB . A", horizon=4, goals=(goal, goal))


def resources() -> Problem:
    """The middle of the crossing and the edges to it are a mutex."""
    drawn = problem(CROSSING)
    middle = drawn.roadmap.nearest(1.5, 1.5)[0]
    into = np.flatnonzero(drawn.roadmap.edges[:, 1] == middle)
    mutex = Resource(name="middle", kind="mutex", vertices=(middle,), edges=tuple(into.tolist()))
    return problem(CROSSING, roadmap=attrs.evolve(drawn.roadmap, resources=(mutex,)))


def headings() -> Problem:
    """A roadmap with a vertex that prescribes a yaw."""
    line = grid(1, 3)
    return problem("a . A", roadmap=attrs.evolve(line, heading=np.array([np.nan, 0.0, np.nan])))


def choice(at_goal: str) -> Problem:
    """Either robot may take either goal; the left one is nearer to both."""
    drawn = problem("a b A . B")
    ends = tuple(goals[0] for (goals,) in drawn.goals)
    return problem("a b A . B", goals=((ends,), (ends,)), rules=Rules(at_goal=at_goal))


def edge_between(drawn: Problem, tail: tuple[float, float], head: tuple[float, float]) -> int:
    """The edge from one point of a drawing to another."""
    ends = drawn.roadmap.nearest(*tail)[0], drawn.roadmap.nearest(*head)[0]
    return int(np.flatnonzero((drawn.roadmap.edges == ends).all(axis=1))[0])


_SOLVABLE: dict[str, Callable[[], Problem]] = {
    "a robot alone": lambda: problem("a . . A"),
    "a robot at its goal": lambda: problem("aA ."),
    "a crossing": lambda: problem(CROSSING),
    "a corridor with a bay": lambda: problem(BAY),
    "a parked robot in the way": lambda: problem("# # . # #\n a . bB . A"),
    "a ring of four": lambda: problem("aD bA\n dC cB"),
    "one-way lanes": one_way,
    "robots that disappear at their goals": lambda: problem("b a A . B", rules=Rules(at_goal="disappear")),
    "edges of different durations": lambda: slow_lanes(CROSSING),
    "a corridor of different durations": lambda: slow_lanes(BAY),
    "footprints at a crossing": lambda: problem(CROSSING, radius=0.3, features={Feature.FOOTPRINTS}),
    "footprints wider than a cell": lambda: problem(WIDE, radius=0.55, features={Feature.FOOTPRINTS}),
    "footprints and different durations": lambda: slow_lanes(CROSSING, frozenset({Feature.FOOTPRINTS}), 0.3),
    "two motion profiles": profiles,
    "goal sets": lambda: problem("A b B\n . a .\n A . B"),
    "commitments": commitments,
    "commitments that begin at different times": since,
    "goal sequences": goal_sequences,
    "a horizon": lambda: problem(BAY, horizon=2),
    "a goal of two robots": shared_goal,
    "following forbidden": lambda: problem(CONVOY, rules=Rules(following="forbidden")),
    "following forbidden at a crossing": lambda: problem(CROSSING, rules=Rules(following="forbidden")),
    "resources": resources,
    "headings": headings,
}
OPTIMA: dict[str, int] = {
    "a robot alone": 3,
    "a robot at its goal": 0,
    "a crossing": 5,
    "a corridor with a bay": 11,
    "a parked robot in the way": 7,
    "a ring of four": 4,
    "one-way lanes": 5,
    "robots that disappear at their goals": 5,
    "edges of different durations": 10,
    "a corridor of different durations": 18,
    "footprints at a crossing": 6,
    "footprints wider than a cell": 11,
    "footprints and different durations": 14,
    "two motion profiles": 6,
    "goal sets": 3,
    "commitments": 7,
    "goal sequences": 4,
    "following forbidden": 7,
    "following forbidden at a crossing": 6,
    "resources": 5,
    "headings": 2,
}
"""The least sum of costs of these problems, in ticks, found by brute force."""
_CHOICES: dict[str, Callable[[], Problem]] = {
    "goals of which one is the nearest to both robots": lambda: choice("stay"),
    "such goals, at which robots disappear": lambda: choice("disappear"),
}
_UNSOLVABLE: dict[str, Callable[[], Problem]] = {
    "a goal behind a wall": lambda: problem("a # A\n . # ."),
    "a swap in a dead end": lambda: problem("aB . bA"),
}


def solvable() -> dict[str, Problem]:
    """Problems with a plan, by name."""
    return {name: make() for name, make in _SOLVABLE.items()}


def choices() -> dict[str, Problem]:
    """Problems in which a planner that assigns chooses the goal of each robot, by name."""
    return {name: make() for name, make in _CHOICES.items()}


def unsolvable() -> dict[str, Problem]:
    """Problems without a plan, by name."""
    return {name: make() for name, make in _UNSOLVABLE.items()}
