"""The solvers in one call, without anything else of mrpbench."""

import doctest
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_native import ALGORITHMS, DirectedGraph, Grid, describe, options_of, solve, solving

OPEN = np.ones((4, 4), bool)


def test_the_example_in_the_documentation_holds():
    assert doctest.testmod(solving, extraglobs={"np": np}).failed == 0


def test_paths_on_a_grid_are_cells_at_every_tick():
    solution = solve(OPEN, [[0, 0], [0, 3]], [[0, 3], [0, 0]], algorithm="cbs")
    assert solution.status == "solved"
    assert solution.cost == 8
    assert solution.makespan == max(map(len, solution.paths)) - 1
    assert solution.lower_bound == 8
    for path, start, goal in zip(solution.paths, [[0, 0], [0, 3]], [[0, 3], [0, 0]], strict=True):
        assert (path[0].tolist(), path[-1].tolist()) == (start, goal)
        assert (np.abs(np.diff(path, axis=0)).sum(axis=1) <= 1).all()


def test_paths_on_a_graph_are_vertices_and_when_they_are_reached():
    loop = DirectedGraph(edges=[(0, 1), (1, 2), (2, 0)], duration=[2, 3, 4])
    solution = solve(loop, [0], [2], algorithm="cbs")
    assert solution.paths[0].tolist() == [[0, 0], [1, 2], [2, 5]]
    assert (solution.cost, solution.makespan) == (5, 5)


def test_robots_choose_among_candidates():
    solution = solve(OPEN, [[0, 0], [3, 3]], [[[3, 3], [0, 1]], [[3, 3], [0, 1]]], algorithm="cbs")
    assert solution.cost == 1
    assert [path[-1].tolist() for path in solution.paths] == [[0, 1], [3, 3]]


def test_a_problem_without_robots_is_solved():
    solution = solve(OPEN, np.empty((0, 2), int), np.empty((0, 2), int), algorithm="cbs")
    assert (solution.status, solution.paths, solution.cost) == ("solved", (), 0)


def test_an_unsolvable_problem_has_no_paths():
    walled = OPEN.copy()
    walled[:, 1] = False
    solution = solve(walled, [[0, 0]], [[0, 3]], algorithm="cbs")
    assert (solution.status, solution.paths, solution.cost) == ("unsolvable", (), None)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1), st.sampled_from(sorted(ALGORITHMS)))
def test_every_algorithm_returns_paths_from_starts_to_goals(seed, algorithm):
    random = np.random.default_rng(seed)
    free = random.random((5, 5)) < 0.8
    cells = random.permutation(np.argwhere(free))
    robots = min(3, len(cells) // 2)
    starts, goals = cells[:robots], random.permutation(cells)[:robots]
    solution = solve(Grid(free), starts, goals, algorithm=algorithm, time_limit=0.5)
    if solution.paths:
        assert [path[0].tolist() for path in solution.paths] == starts.tolist()
        assert [path[-1].tolist() for path in solution.paths] == goals.tolist()
        assert solution.cost == sum(len(path) - 1 for path in solution.paths)
        assert not solution.cost < solution.lower_bound
        assert all(free[tuple(path.T)].all() for path in solution.paths)
    else:
        assert solution.status != "solved"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"roadmap": np.ones((2, 2))}, r"a grid is bool\[rows, columns\]"),
        ({"starts": [[0, 4]]}, r"starts: number 0 is \[0, 4\], which is blocked or does not exist"),
        ({"goals": [[0, -1]]}, r"goals: number 0 is \[0, -1\]"),
        ({"goals": [[0, 1], [0, 2]]}, "goals: 2 for 1 robots"),
        ({"goals": [0]}, "goals: one for each robot, or a list of candidates"),
        ({"starts": [[0.5, 1]]}, "starts: whole numbers are needed, not float64"),
        ({"starts": [0]}, r"starts: needs a row and a column each, but the array has shape \(1,\)"),
        ({"algorithm": "magic"}, "there is no algorithm 'magic'; there are: astar"),
        ({"algorithm": "cbs", "v": 2}, "cbs has no option 'v'; it has: "),
        ({"algorithm": "cbs", "bypass": "no"}, "cbs: bypass must be true or false, not 'no'"),
        ({"algorithm": ["cbs"]}, r"there is no algorithm \['cbs'\]"),
        ({"algorithm": "eecbs", "w": 0.5}, "eecbs: w must be a number from 1 to 1e[+]09, not 0.5"),
        ({"algorithm": "eecbs", "w": np.nan}, "w must be a number from 1 to 1e[+]09, not nan"),
        ({"algorithm": "eecbs", "distance_weight": np.inf}, "distance_weight must be a number from 1 to 1000, not inf"),
        ({"algorithm": "eecbs", "distance_weight": 0.0}, "distance_weight must be a number from 1 to 1000, not 0"),
        (
            {"algorithm": "eecbs", "conflict_weight": np.nan},
            "conflict_weight must be a number from 0 to 1e[+]06, not nan",
        ),
        (
            {"algorithm": "eecbs", "incumbent_after": -1},
            "incumbent_after must be a whole number of at least 0, or none, not -1",
        ),
        (
            {"algorithm": "eecbs", "selection": "best"},
            "selection must be one of best_first, focal, explicit_estimation, not 'best'",
        ),
        ({"algorithm": "lacam", "iterations": -1}, "iterations must be a whole number of at least 0, or none, not -1"),
        ({"algorithm": "lacam", "seed": -1}, "lacam: seed must be a whole number of at least 0, not -1"),
        ({"algorithm": "lns", "iterations": -1}, "iterations must be a whole number of at least 0, or none, not -1"),
        ({"algorithm": "lacam", "seed": 2**63}, "lacam: seed is too large"),
        ({"algorithm": "lacam", "seed": 1.5}, "lacam: seed must be a whole number of at least 0, not 1.5"),
        ({"algorithm": "eecbs", "w": "1.2"}, "eecbs: w must be a number from 1 to 1e[+]09, not '1.2'"),
        ({"algorithm": "eecbs", "w": []}, "eecbs: w cannot be a <class 'list'>"),
        ({"algorithm": "eecbs", "w": None}, "eecbs: w must be a number from 1 to 1e[+]09, not none"),
        (
            {"algorithm": "lns", "neighbourhood": 0},
            "neighbourhood must be a whole number of at least 1, or none, not 0",
        ),
        ({"algorithm": "pibt", "steps": -1}, "steps must be a whole number of at least 0, not -1"),
        ({"algorithm": "prioritized", "restarts": -1}, "restarts must be a whole number of at least 0, not -1"),
        ({"time_limit": -1}, "time_limit: seconds from 0 are needed, not -1"),
        ({"time_limit": np.nan}, "time_limit: seconds from 0 are needed, not nan"),
        ({"time_limit": "1"}, "time_limit: seconds from 0 are needed, not '1'"),
        ({"memory_limit": -1}, "memory_limit: a whole number of bytes from 0 is needed, not -1"),
        ({"memory_limit": 2.5}, "memory_limit: a whole number of bytes from 0 is needed, not 2.5"),
        ({"memory_limit": 2**63}, "memory_limit: a whole number of bytes from 0 is needed"),
        ({"roadmap": np.ones((0, 3), bool)}, r"starts: number 0 is \[0, 0\], which is blocked or does not exist"),
        ({"roadmap": None}, r"a grid is bool\[rows, columns\]"),
        ({"starts": [[0, 0], [0]]}, "starts: an array is needed, but the rows differ in length"),
        ({"starts": None}, "starts: whole numbers are needed, not object"),
        ({"starts": np.full((1, 2), 2**63, "u8")}, "starts: 9223372036854775808 is too large"),
        ({"goals": None}, "goals: one for each robot, or a list of candidates"),
        ({"goals": 3}, "goals: one for each robot, or a list of candidates"),
        ({"goals": np.array(3)}, "goals: one for each robot, or a list of candidates"),
        ({"goals": [[0, 0], [0]]}, "goals: an array is needed, but the rows differ in length"),
        ({"goals": [[[0, 0], [0]]]}, "goals: one for each robot, or a list of candidates"),
        ({"goals": [np.empty((0, 2), int)]}, "robot 0: has no goal"),
        ({"roadmap": DirectedGraph(edges=[(0, 1)]), "starts": [5], "goals": [1]}, "starts: number 0 is 5"),
    ],
)
def test_mistakes_are_named_in_the_error(arguments, said):
    asked = {"roadmap": OPEN, "starts": [[0, 0]], "goals": [[1, 1]], "algorithm": "astar"} | arguments
    with pytest.raises(ValueError, match=said):
        solve(**asked)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"edges": [(0, -1)]}, "numbered from 0"),
        ({"edges": [(0, 3)], "vertices": 3}, "from 0 to 2"),
        ({"edges": [(0, 1)], "duration": [0]}, "at least one tick"),
        ({"edges": [(0, 1)], "duration": 2**21}, "at most 1048576"),
        ({"edges": [(0, 1)], "duration": 2**32 + 1}, "at most 1048576"),
        ({"edges": [(0, 1)], "duration": [1, 2]}, r"one value for all or for each of 1 edges, but has shape \(2,\)"),
        ({"edges": [(0, 1)], "duration": 1.5}, "duration: whole numbers are needed"),
        ({"edges": [(0, 1, 2)]}, r"edges: each row needs from and to, but the array has shape \(1, 3\)"),
        ({"edges": [0, 1]}, r"edges: each row needs from and to, but the array has shape \(2,\)"),
        ({"edges": [(0, 1), (1,)]}, "edges: an array is needed, but the rows differ in length"),
        ({"edges": [(0, 2**40)]}, "are more than the supported 2147483647"),
        ({"edges": [], "vertices": 2.5}, "vertices: a whole number is needed, not 2.5"),
    ],
)
def test_invalid_graphs_are_refused(arguments, said):
    with pytest.raises(ValueError, match=said):
        DirectedGraph(**arguments)


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=4),
    max_leaves=8,
)
places = st.lists(st.tuples(st.integers(-1, 4), st.integers(-1, 4)), max_size=5)


@settings(deadline=None, max_examples=150)
@given(
    starts=anything | places,
    goals=anything | places | st.lists(places, max_size=3),
    algorithm=st.sampled_from(sorted(ALGORITHMS)),
    time_limit=st.just(0.1) | anything.filter(lambda it: not isinstance(it, int | float) or it < 0.1),
    memory_limit=st.sampled_from([0, 1 << 10, 1 << 20, 1 << 30]) | anything,
)
def test_any_input_gives_a_solution_or_a_clear_error(starts, goals, algorithm, time_limit, memory_limit):
    refusal = ""
    try:
        solution = solve(OPEN, starts, goals, algorithm=algorithm, time_limit=time_limit, memory_limit=memory_limit)
    except ValueError as error:
        refusal = str(error)
    assert "\n" not in refusal
    assert len(refusal) < 400
    assert refusal or (solution.cost is not None) == (solution.status == "solved")


def test_arrays_need_not_be_contiguous():
    wide = np.ones((8, 8), bool)
    wide[0, 2] = False
    places = np.array([[0, 0], [9, 9], [3, 3], [9, 9]])[::2]
    solution = solve(np.asfortranarray(wide)[::2, ::2], places, places[::-1], algorithm="cbs")
    assert (solution.status, solution.cost) == ("solved", 12)


@pytest.mark.parametrize("algorithm", sorted(ALGORITHMS))
def test_a_roadmap_larger_than_the_memory_is_out_of_memory(algorithm):
    endless = DirectedGraph(edges=[(0, 1)], vertices=2**30)
    assert solve(endless, [0], [1], algorithm=algorithm, memory_limit=1 << 30).status == "out_of_memory"


@pytest.mark.parametrize("algorithm", sorted(ALGORITHMS))
def test_every_algorithm_reports_memory_within_its_limit(algorithm):
    least = 4 * OPEN.size  # bytes of one table of distances
    asked = {"starts": [[0, 0], [3, 3]], "goals": [[3, 3], [0, 0]], "algorithm": algorithm, "time_limit": 0.2}
    solution = solve(OPEN, **asked)
    taken = solution.statistics["memory_bytes"]
    assert solution.status == "solved"
    assert least < taken
    assert solve(OPEN, **asked, memory_limit=least).status == "out_of_memory"


def test_options_are_listed_with_their_defaults():
    assert options_of("cbs")["bypass"] is True
    assert options_of("prioritized")["restarts"] == 1000
    assert options_of("eecbs")["w"] == 1.2
    assert options_of("ecbs")["bypass"] is False
    assert options_of("lacam")["iterations"] is None


@pytest.mark.parametrize("algorithm", sorted(ALGORITHMS))
def test_every_option_is_described_and_takes_its_default_and_nothing_beyond_its_range(algorithm):
    described = describe(algorithm)
    assert described.help.endswith(".")
    asked = {"roadmap": OPEN, "starts": [[0, 0]], "goals": [[1, 1]], "algorithm": algorithm, "time_limit": 0.2}
    assert solve(**asked, **options_of(algorithm)).status == "solved"
    for option in described.options:
        assert option.help
        assert not option.help.endswith(".")
        wrong = [object(), *([] if option.optional else [None])]
        wrong += ["other"] if option.type == "str" else []
        wrong += [option.least - 1] if option.least is not None else []
        wrong += [option.most * 2] if option.most is not None else []
        for value in wrong:
            with pytest.raises(ValueError, match=f"^{algorithm}: {option.name} "):
                solve(**asked, **{option.name: value})


def test_numbers_of_numpy_are_options_too():
    asked = {"roadmap": OPEN, "starts": [[0, 0]], "goals": [[1, 1]], "time_limit": 0.2}
    assert solve(**asked, algorithm="eecbs", w=np.float32(1.5), incumbent_after=np.int64(3)).status == "solved"
    assert solve(**asked, algorithm="pibt", seed=np.uint8(3)).status == "solved"


@pytest.mark.parametrize("algorithm", ["cbs_ta", "ita_cbs", "ecbs_ta", "ita_ecbs"])
def test_robots_choose_among_more_goals_than_robots(algorithm):
    goals = [[0, 1], [3, 2], [2, 0]]
    solution = solve(OPEN, [[0, 0], [3, 3]], [goals, goals[1:]], algorithm=algorithm)
    assert [path[-1].tolist() for path in solution.paths] == [[0, 1], [3, 2]]
    assert solution.cost == solution.lower_bound == 2
    assert solution.statistics["assignments"] >= 1


def test_no_other_package_of_mrpbench_is_imported():
    code = "import sys, mrpbench_native; sys.exit(any(name.startswith('mrpbench_core') for name in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
