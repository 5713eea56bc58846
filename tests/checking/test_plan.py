"""Paths that are not paths of their problem are found and named."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Rules

LANE = [(0, 1, 1), (1, 1, 3), (1, 2, 4)]


def fault(problem, path):
    """Return the fault of a plan of one path, without the robot's name, or None."""
    report = check_plan(problem, Plan(paths=(path,)))
    assert not report.conflicts
    assert report.valid == (not report.faults)
    return report.faults[0].removeprefix("robot 0: ") if report.faults else None


@pytest.fixture(scope="module")
def lane(make):
    return make.grid(1, 4)


def test_a_sound_path_has_no_fault(make, lane):
    assert fault(make.problem(lane, [0], goals=(((2,),),)), make.path(lane, *LANE)) is None


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"enter": [0, 1]}, "edge, enter and leave differ in length"),
        ({"edge": [0, -1, 99]}, "uses an edge that does not exist"),
        ({"edge": [0, -2, 2]}, "uses an edge that does not exist"),
        ({"enter": [1, 1, 3]}, "begins at tick 1 instead of 0"),
        ({"enter": [0, 2, 3]}, "segment 1 does not begin when segment 0 ends"),
        ({"enter": [0, 1, 0], "leave": [1, 0, 4]}, "segment 1 ends before it begins"),
        ({"edge": [2, -1, 2]}, "starts at vertex 1 instead of 0"),
        ({"edge": [0, -1, 4]}, "jumps to another vertex at segment 2"),
        ({"leave": [1, 3, 3]}, "segment 2 is shorter than the duration of its edge"),
    ],
)
def test_each_fault_of_a_path_is_named(make, lane, change, said):
    sound = make.path(lane, *LANE)
    assert fault(make.problem(lane, [0], goals=(((2,),),)), attrs.evolve(sound, **change)) == said


def test_a_move_may_take_longer_than_its_edge(make, lane):
    asked = make.problem(lane, [0], goals=(((1,),),))
    assert fault(asked, make.path(lane, (0, 1, 9))) is None


def test_a_slow_edge_must_be_given_its_time(make):
    slow = make.grid(1, 2, ticks=3)
    asked = make.problem(slow, [0], goals=(((1,),),))
    assert fault(asked, make.path(slow, (0, 1, 3))) is None
    assert fault(asked, make.path(slow, (0, 1, 2))) == "segment 0 is shorter than the duration of its edge"


def test_each_robot_is_held_to_its_own_profile(make, lane):
    two = attrs.evolve(lane, duration=[[1] * 6, [-1, *[2] * 5]])
    quick = make.problem(two, [0], goals=(((1,),),))
    assert fault(quick, make.path(two, (0, 1, 1))) is None
    other = attrs.evolve(quick, profile=[1])
    assert fault(other, make.path(two, (0, 1, 2))) == "uses edge 0, which its motion profile forbids"
    back = attrs.evolve(other, start=[1], goals=(((0,),),))
    assert fault(back, make.path(two, (1, 0, 1))) == "segment 0 is shorter than the duration of its edge"
    assert fault(back, make.path(two, (1, 0, 2))) is None


def test_no_robot_moves_before_it_is_ready(make, lane):
    asked = make.problem(lane, [0], goals=(((1,),),), ready=[3])
    assert fault(asked, make.path(lane, (0, 0, 2), (0, 1, 3))) == "moves at tick 2, before it is ready at 3"
    assert fault(asked, make.path(lane, (0, 0, 3), (0, 1, 4))) is None


def test_committed_segments_are_kept(make, lane):
    committed = make.path(lane, (0, 1, 1), (1, 1, 3))
    asked = make.problem(lane, [0], goals=(((1, 2),),), commitments=(committed,))
    said = "does not begin with its committed 2 segments"
    assert fault(asked, make.path(lane, *LANE)) is None
    assert fault(asked, committed) is None
    assert fault(asked, make.path(lane, (0, 1, 1), (1, 2, 2))) == said
    assert fault(asked, make.path(lane, (0, 1, 1))) == said
    assert fault(asked, make.path(lane, (0, 1, 2), (1, 1, 3))) == said
    at_goal = make.problem(lane, [1], goals=(((1,),),), commitments=(make.path(lane, (1, 2, 1)),))
    assert fault(at_goal, make.path(lane)) == "does not begin with its committed 1 segments"


@pytest.mark.parametrize(
    ("goals", "said"),
    [
        ((), None),
        (((2,),), None),
        (((1, 2),), None),
        (((1,), (2,)), None),
        (((0,), (1,), (2,)), None),
        (((2,), (2,)), None),
        (((3,),), "ends at vertex 2 instead of its goal 3"),
        (((1, 3),), "ends at vertex 2 instead of its goal 1 or 3"),
        (((3,), (2,)), "does not visit goal 0 of its sequence in order"),
        (((1,), (0,), (2,)), "does not visit goal 1 of its sequence in order"),
        (((2,), (1,), (2,)), "does not visit goal 1 of its sequence in order"),
    ],
)
def test_goals_are_visited_in_order_and_the_last_is_the_end(make, lane, goals, said):
    assert fault(make.problem(lane, [0], goals=(goals,)), make.path(lane, *LANE)) == said


def test_a_robot_without_a_path_must_stand_at_its_goal(make, lane):
    nothing = make.path(lane)
    assert fault(make.problem(lane, [2], goals=(((2,),),)), nothing) is None
    assert fault(make.problem(lane, [0], goals=(((2,),),)), nothing) == "ends at vertex 0 instead of its goal 2"


def test_every_robot_needs_a_path(make, lane):
    asked = make.problem(lane, [0, 3])
    assert check_plan(asked, Plan(paths=(make.path(lane),))).faults == ("1 paths for 2 robots",)
    both = check_plan(asked, Plan(paths=(make.path(lane, (2, 3, 1)), make.path(lane, (1, 0, 1)))))
    assert both.faults == (
        "robot 0: starts at vertex 2 instead of 0",
        "robot 1: starts at vertex 1 instead of 3",
    )


def test_conflicts_are_looked_for_only_between_sound_paths_and_up_to_a_limit(make, lane):
    asked = make.problem(lane, [0, 0, 3])
    crowd = Plan(paths=(make.path(lane, (0, 1, 1)), make.path(lane, (0, 1, 1)), make.path(lane)))
    assert len(check_plan(asked, crowd).conflicts) == 3  # at the start, on the edge, at its end
    assert len(check_plan(asked, crowd, conflict_limit=1).conflicts) == 1
    assert not check_plan(asked, crowd, conflict_limit=0).conflicts
    assert len(check_plan(asked, crowd).conflicts) == 3  # what was not searched for is not remembered
    unsound = Plan(paths=(*crowd.paths[:2], make.path(lane, (0, 1, 1))))
    assert not check_plan(asked, unsound).conflicts


def test_reports_of_the_plan_and_the_problem_before_are_not_given_to_others(make, lane):
    asked = make.problem(lane, [0, 3])
    sound = Plan(paths=(make.path(lane, (0, 1, 1)), make.path(lane)))
    jump = Plan(paths=(make.path(lane, (2, 3, 1)), make.path(lane)))
    elsewhere = make.problem(lane, [1, 3])
    for _ in range(2):
        assert check_plan(asked, sound).valid
        assert check_plan(asked, jump).faults == ("robot 0: starts at vertex 2 instead of 0",)
        assert check_plan(asked, sound).valid
        assert check_plan(elsewhere, sound).faults == ("robot 0: starts at vertex 0 instead of 1",)


def walks(problem, path):
    """Tell by walking it step by step whether a single path is sound: an oracle of its own."""
    at, now, moved = int(problem.start[0]), 0, False
    for edge, enter, leave in zip(path.edge.tolist(), path.enter.tolist(), path.leave.tolist(), strict=True):
        if enter != now or leave < enter or not -1 <= edge < len(problem.roadmap.edges):
            return False
        if edge >= 0:
            ticks = int(problem.roadmap.duration[problem.profile[0], edge])
            if int(problem.roadmap.edges[edge, 0]) != at or ticks < 0 or leave - enter < ticks:
                return False
            if not moved and enter < problem.ready[0]:
                return False
            at, moved = int(problem.roadmap.edges[edge, 1]), True
        now = leave
    return at == problem.goals[0][0][0]


@settings(deadline=None, max_examples=300)
@given(st.integers(0, 2**32 - 1))
def test_random_mutations_of_a_sound_path_are_judged_as_by_walking_it(make, seed):
    random = np.random.default_rng(seed)
    roadmap = make.grid(3, 3, ticks=random.integers(1, 4, 24))
    roadmap = attrs.evolve(roadmap, duration=np.where(random.random(24) < 0.1, -1, roadmap.duration))
    at, now, edge, enter, leave = int(random.integers(9)), int(random.integers(3)), [], [], []
    asked = make.problem(roadmap, [at], ready=[now])
    if now:
        edge, enter, leave = [-1], [0], [now]
    for _ in range(random.integers(1, 7)):
        ways = np.flatnonzero((roadmap.edges[:, 0] == at) & (roadmap.duration[0] >= 0))
        take = -1 if random.random() < 0.3 or not len(ways) else int(random.choice(ways))
        edge.append(take)
        enter.append(now)
        now += int(random.integers(3)) + (0 if take < 0 else int(roadmap.duration[0, take]))
        leave.append(now)
        at = at if take < 0 else int(roadmap.edges[take, 1])
    asked = attrs.evolve(asked, goals=(((at,),),))
    sound = RobotPath(edge=edge, enter=enter, leave=leave)
    assert walks(asked, sound)
    assert fault(asked, sound) is None
    arrays = {"edge": sound.edge.copy(), "enter": sound.enter.copy(), "leave": sound.leave.copy()}
    for _ in range(random.integers(1, 3)):
        where = int(random.integers(len(edge)))
        name = str(random.choice(list(arrays)))
        arrays[name][where] = (
            random.integers(-2, 26) if name == "edge" else arrays[name][where] + random.integers(-2, 3)
        )
    changed = RobotPath(**arrays)
    assert (fault(asked, changed) is None) == walks(asked, changed)


def test_robots_that_disappear_at_their_goals_let_others_end_there(make, lane):
    paths = (make.path(lane, (0, 1, 1)), make.path(lane, (2, 2, 1), (2, 1, 2)))
    goals = (((1,),), ((1,),))
    staying = make.problem(lane, [0, 2], goals=goals)
    assert [conflict.kind for conflict in check_plan(staying, Plan(paths=paths)).conflicts] == ["vertex"]
    gone = attrs.evolve(staying, rules=Rules(at_goal="disappear"))
    assert check_plan(gone, Plan(paths=paths)).valid
    waits = Plan(paths=(make.path(lane, (0, 1, 1), (1, 1, 2)), paths[1]))
    assert not check_plan(gone, waits).valid  # it disappears only when its path ends


def test_all_conflicts_are_counted_unless_told_otherwise(make):
    robots = 150
    problem = make.problem(make.grid(1, 2), [0] * robots)
    nothing = RobotPath(edge=[], enter=[], leave=[])
    pairs = robots * (robots - 1) // 2
    assert len(check_plan(problem, Plan(paths=(nothing,) * robots)).conflicts) == pairs > 10_000
    assert len(check_plan(problem, Plan(paths=(nothing,) * robots), conflict_limit=3).conflicts) == 3
