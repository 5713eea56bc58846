"""Cases of a hunt, and what makes them smaller."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.moves import Moves
from mrpbench_search.hunting.properties import Verdict
from mrpbench_search.hunting.runs import Judged
from mrpbench_search.hunting.search import Hunt
from mrpbench_search.hunting.shrink import shrink
from mrpbench_search.hunting.space import Space, _kinds, _ways
from scipy.optimize import linear_sum_assignment

from mrpbench_core.model.planning.scenario import Scenario, Task

SIDE = 6
STOP = {"kind": "stop", "at": 5.0, "lasts": 16.0, "robot": 0}


def space(robots=4):
    """A grid of 1 m, each vertex a place."""
    position = np.array([(x, y) for y in range(SIDE) for x in range(SIDE)], float)
    pairs = [(a, b) for a in range(len(position)) for b in range(len(position))]
    edges = np.array([pair for pair in pairs if abs(position[pair[0]] - position[pair[1]]).sum() == 1], np.int32)
    roadmap = {
        "position": position,
        "level": np.zeros(len(position), np.int16),
        "edges": edges,
        "duration": np.ones((1, len(edges)), np.int32),
    }
    pose = np.column_stack([position, np.full(len(position), np.nan)])
    tasks = tuple(Task(goals=pose[[-1 - index]]) for index in range(robots))
    drawn = Scenario(start=pose[:robots], start_level=np.zeros(robots, np.int16), tasks=tasks)
    return Space(
        scenarios=(drawn,),
        streams=None,
        position=position,
        level=roadmap["level"],
        vertex_position=position,
        kinds=_kinds(edges, len(position), []),
        room=0.5,
        tick=1.0,
        **_ways(roadmap, position, roadmap["level"]),
    )


SPACE = space()
FIRST = Case(scenario=SPACE.scenarios[0], seed=3, events=(STOP,))


def moves(seed):
    return Moves(space=SPACE, first=FIRST, rng=np.random.default_rng(seed))


def distinct(poses):
    return len(np.unique(np.array(poses)[:, :2], axis=0)) == len(poses)


@given(st.integers(0, 10**6))
def test_cases_have_robots_at_distinct_starts_and_goals_of_the_study(seed):
    made = moves(seed)
    new = made.new()
    for case in (new, made.near(new), made.near(made.near(new))):
        assert case.robots == 4
        assert distinct(case.scenario.start)
        assert distinct([task.goals[0] for task in case.tasks])
        assert 0 <= case.events[0]["robot"] < 4
        assert case.events[0]["lasts"] > 0


def test_the_same_seed_makes_the_same_cases():
    assert [moves(5).new().key for _ in range(2)] == [moves(5).new().key for _ in range(2)]
    assert moves(5).new().key != moves(6).new().key


@given(st.integers(0, 10**6))
def test_two_robots_of_a_new_case_meet_head_on_at_about_the_same_time(seed):
    case = moves(seed)._meeting(FIRST, 1, 2)
    if case is not FIRST:
        ends = [(place(case.scenario.start[robot]), place(case.tasks[robot].goals[0])) for robot in (1, 2)]
        assert meets(*ends[0], *ends[1])


@given(st.integers(0, 10**6))
def test_tasks_over_time_come_to_one_vertex_at_about_the_same_time(seed):
    tasks = tuple(Task(goals=FIRST.tasks[at % 4].goals, release=20.0 * at, deadline=20.0 * at + 9) for at in range(8))
    case = Case(scenario=attrs.evolve(FIRST.scenario, tasks=()), seed=0, stream=tasks)
    gathered = moves(seed)._gathered(case)
    moved = [task for task in gathered.tasks if task.release % 20]
    first = min((task.release for task in moved), default=0.0) // 20 * 20
    assert len(moved) <= 3
    assert all(first < task.release == pytest.approx(task.deadline - 9) for task in moved)
    assert [task.index for task in gathered.tasks] == list(range(8))


def test_nearly_all_new_cases_have_such_a_pair():
    made = moves(0)
    assert sum(made._meeting(FIRST, 1, 2) is not FIRST for _ in range(100)) > 80


@given(st.integers(0, 10**6))
def test_a_robot_passes_the_start_or_the_goal_of_another_one(seed):
    case = moves(seed)._passing(FIRST, 1, 2)
    assert case is not FIRST
    start, goal = place(case.scenario.start[1]), place(case.tasks[1].goals[0])
    ways = SPACE.distance
    ends = place(FIRST.scenario.start[2]), place(FIRST.tasks[2].goals[0])
    assert any(start != end != goal and ways[start, end] + ways[end, goal] == ways[start, goal] for end in ends)


@given(st.integers(0, 10**6))
def test_a_robot_comes_to_the_goals_of_others_long_after_they_have_arrived(seed):
    case = moves(seed)._resting(FIRST, [1, 0, 2, 3])
    assert distinct(case.scenario.start)
    assert distinct([task.goals[0] for task in case.tasks])
    ways, starts = SPACE.distance, [place(pose) for pose in case.scenario.start]
    goals = [place(task.goals[0]) for task in case.tasks]
    passed = [
        other
        for other in (0, 2, 3)
        if ways[starts[1], goals[other]] + ways[goals[other], goals[1]] == ways[starts[1], goals[1]]
    ]
    assert max(ways[starts[1], goals[other]] - ways[starts[other], goals[other]] for other in passed) >= SIDE / 2


def place(pose):
    return int(pose[0] + SIDE * pose[1])


def meets(start, goal, other_start, other_goal):
    """Tell whether shortest ways of two robots have an edge in opposite directions within a tick."""
    distance = SPACE.distance
    for tail, head in zip(*SPACE.ways.nonzero(), strict=True):
        one = distance[start, tail] + 1 + distance[head, goal] == distance[start, goal]
        two = distance[other_start, head] + 1 + distance[tail, other_goal] == distance[other_start, other_goal]
        if one and two and abs(distance[start, tail] - distance[other_start, head]) <= 1:
            return True
    return False


def test_kinds_keep_rare_vertices_apart():
    sizes = sorted(len(kind) for kind in SPACE.kinds)
    assert sum(sizes) == SIDE**2
    assert sizes[0] == 4  # corners


def test_a_robot_that_is_left_out_takes_its_goal_and_its_faults_along():
    smaller = attrs.evolve(FIRST, events=(STOP, STOP | {"robot": 2}, STOP | {"robot": None})).without_robot(0)
    assert smaller.robots == len(smaller.tasks) == 3
    assert [event["robot"] for event in smaller.events] == [1, None]
    np.testing.assert_array_equal(smaller.scenario.start, FIRST.scenario.start[1:])


class Runs:
    """Judges cases by a function, without runs."""

    def __init__(self, fails):
        self.fails, self.asked = fails, 0

    def judge(self, cases, word, first=1):
        self.asked += len(cases)
        verdicts = [
            Verdict(margin=-1.0, failures=("contact",)) if self.fails(c) else Verdict(margin=1.0) for c in cases
        ]
        return [
            Judged(case=case, records=({"run_id": "a", "status": "succeeded"},), verdict=verdict)
            for case, verdict in zip(cases, verdicts, strict=True)
        ]

    def signature(self, judged, kind):
        return kind, kind

    def as_assigned(self, judged):
        return judged.case


@pytest.mark.parametrize("needed", [{0, 3}, {2}, {0, 1, 2, 3}])
def test_shrinking_leaves_exactly_the_robots_that_a_failure_needs(needed):
    starts = {tuple(FIRST.scenario.start[robot, :2]) for robot in needed}

    def fails(case):
        return starts <= {tuple(pose) for pose in case.scenario.start[:, :2].tolist()}

    runs = Runs(fails)
    smallest, ended = shrink(runs.judge([FIRST], "case")[0], runs, lambda judged: bool(judged.verdict.failures))
    assert ended
    assert smallest.case.robots == len(needed)
    assert smallest.case.events == ()
    assert runs.asked < 40


def test_two_robots_that_a_failure_needs_both_or_neither_are_left_out():
    starts = [tuple(pose) for pose in FIRST.scenario.start[:, :2].tolist()]

    def fails(case):
        there = {tuple(pose) for pose in case.scenario.start[:, :2].tolist()}
        return {starts[0], starts[3]} <= there and (starts[1] in there) == (starts[2] in there)

    runs = Runs(fails)
    smallest, ended = shrink(runs.judge([FIRST], "case")[0], runs, lambda judged: bool(judged.verdict.failures))
    assert (ended, smallest.case.robots) == (True, 2)


def test_a_robot_is_left_out_with_the_goal_that_the_assigner_gave_it():
    def assigned(case):
        goals = np.array([task.goals[0, :2] for task in case.tasks])
        return linear_sum_assignment(np.linalg.norm(case.scenario.start[:, None, :2] - goals, axis=2))[1]

    def ways(case):
        ends = zip(case.scenario.start.tolist(), assigned(case).tolist(), strict=True)
        return {(*start[:2], *case.tasks[goal].goals[0, :2].tolist()) for start, goal in ends}

    class Assigning(Runs):
        def as_assigned(self, judged):
            return judged.case.with_tasks(tuple(judged.case.tasks[goal] for goal in assigned(judged.case)))

    for seed in range(20):
        rng = np.random.default_rng(seed)
        starts, goals = rng.uniform(0, SIDE, (2, 8, 3))
        tasks = tuple(Task(goals=goals[[index]]) for index in range(8))
        case = Case(scenario=Scenario(start=starts, start_level=np.zeros(8, np.int16), tasks=tasks), seed=0)
        needed = set(sorted(ways(case))[:2])
        runs = Assigning(lambda case, needed=needed: needed <= ways(case))
        smallest, _ = shrink(runs.judge([case], "case")[0], runs, lambda judged: bool(judged.verdict.failures))
        assert smallest.case.robots == 2, seed


def test_shrinking_shortens_faults():
    runs = Runs(lambda case: case.events and case.events[0]["lasts"] >= 3)
    smallest, _ = shrink(runs.judge([FIRST], "case")[0], runs, lambda judged: bool(judged.verdict.failures))
    assert [event["lasts"] for event in smallest.case.events] == [4.0]
    assert smallest.case.robots == 1


def test_tasks_over_time_are_left_out_and_keep_their_order():
    tasks = tuple(Task(goals=FIRST.tasks[0].goals, release=float(at), index=at) for at in range(8))
    case = Case(scenario=attrs.evolve(FIRST.scenario, tasks=()), seed=0, stream=tasks)
    runs = Runs(lambda case: 5.0 in [task.release for task in case.tasks])
    smallest, _ = shrink(runs.judge([case], "case")[0], runs, lambda judged: bool(judged.verdict.failures))
    assert [task.release for task in smallest.case.tasks] == [5.0]
    made = attrs.evolve(SPACE, streams=(tasks,))
    for seed in range(20):
        near = Moves(space=made, first=case, rng=np.random.default_rng(seed)).near(case)
        releases = [task.release for task in near.tasks]
        assert releases == sorted(releases)
        assert [task.index for task in near.tasks] == list(range(8))


def test_a_failure_is_listed_once_however_often_it_is_found():
    hunt = Hunt(moves=moves(0), runs=Runs(lambda case: True), announce=lambda line: None)
    for judged in hunt.runs.judge([moves(0).new(), moves(1).new()], "case"):
        hunt._take(judged)
    (failure,) = hunt.failures.values()
    assert failure.times == 2
    assert (failure.again, failure.repeats) == (20, 20)
