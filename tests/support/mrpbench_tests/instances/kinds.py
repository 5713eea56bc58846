"""Kinds of random problems that soaks draw from in turn."""

from collections.abc import Callable

from mrpbench_core.model.planning.problem import Problem
from mrpbench_tests.instances.random_problems import (
    Random,
    random_building_problem,
    random_corridor_problem,
    random_full_problem,
    random_graph_problem,
    random_grid_problem,
    random_narrow_problem,
    random_rules,
)
from mrpbench_tests.instances.variations import with_releases, with_resources

Draw = Callable[[Random], Problem]

KINDS: dict[str, Draw] = {
    "grid": lambda random: random_grid_problem(random, int(random.integers(2, 5)), size=int(random.integers(3, 5))),
    "grid with rules": lambda random: random_grid_problem(
        random, int(random.integers(2, 4)), size=int(random.integers(3, 5)), **random_rules(random)
    ),
    "full grid": random_full_problem,
    "path, cycle or tree": lambda random: random_narrow_problem(random, int(random.integers(2, 5))),
    "corridor": lambda random: random_corridor_problem(
        random, int(random.integers(2, 4)), int(random.choice([1, 1, 3])), **random_rules(random)
    ),
    "unit graph": lambda random: random_graph_problem(
        random, int(random.integers(2, 4)), longest=1, at_goal=str(random.choice(["stay", "disappear"]))
    ),
    "graph": lambda random: random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random)),
    "graph, long lanes": lambda random: random_graph_problem(
        random, int(random.integers(2, 4)), longest=8, radius=0.3, at_goal=str(random.choice(["stay", "disappear"]))
    ),
    "graph, late start": lambda random: random_graph_problem(
        random, 2, ready=random.integers(0, 5, 2), **random_rules(random)
    ),
    "graph, released": lambda random: with_releases(
        random, random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random))
    ),
    "graph, resources": lambda random: with_resources(
        random, random_graph_problem(random, int(random.integers(2, 4)), **random_rules(random))
    ),
    "building": lambda random: random_building_problem(random, int(random.integers(2, 5))),
}
