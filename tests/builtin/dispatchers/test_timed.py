import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.builtin.dispatchers.timed import Timed
from mrpbench_core.model.planning.plan import Plan, RobotPath


def test_each_segment_is_released_when_the_plan_enters_it(make):
    problem, plan = make.solved(make.roadmap([(0, 0), (1, 0), (2, 0)], [(0, 1), (1, 2)], tick=0.5), [[0, 0, 1, 2], [2]])
    session = Timed().start(problem, plan)
    seen = [session.update(now, make.view([0, 0])).released.tolist() for now in (0.0, 0.49, 0.5, 0.99, 1.0, 9.0)]
    assert seen == [[1, 0], [1, 0], [2, 0], [2, 0], [3, 0], [3, 0]]


def test_a_clock_that_sums_up_rounding_errors_releases_in_the_same_period(make):
    problem, plan = make.solved(make.roadmap([(0, 0), (1, 0)], [(0, 1)], tick=0.1), [[0, 0, 0, 0, 1]])
    session = Timed().start(problem, plan)
    assert session.update(0.1 + 0.1 + 0.1 - 1e-12, make.view([0])).released.tolist() == [4]


def test_a_new_plan_goes_on_by_its_own_times_and_keeps_what_was_released(make):
    lane = make.grid(1, 4)
    problem, plan = make.solved(lane, [[0, 1, 2]])
    session = Timed().start(problem, plan)
    assert session.update(1.0, make.view([0])).released.tolist() == [2]
    longer, new = make.solved(lane, [[0, 1, 2, 2, 2, 3]])
    session.adopt(attrs.evolve(longer, commitments=plan.paths), new)
    seen = [session.update(now, make.view([0], revision=1)).released.tolist() for now in (1.1, 2.0, 4.0)]
    assert seen == [[2], [3], [5]]


@settings(deadline=None, max_examples=30)
@given(
    st.lists(st.lists(st.integers(0, 4), max_size=6), min_size=1, max_size=5), st.lists(st.floats(0, 30), max_size=9)
)
def test_released_is_the_count_of_segments_entered_by_now(make, waits, instants):
    paths = []
    for lengths in waits:
        times = np.concatenate([[0], np.cumsum(lengths)]).astype(int)
        paths.append(RobotPath(edge=[-1] * len(lengths), enter=times[:-1], leave=times[1:]))
    plan = Plan(paths=tuple(paths))
    problem = make.problem(make.grid(1, 5), plan, list(range(len(paths))))
    session = Timed().start(problem, plan)
    for now in sorted(instants):
        expected = [sum(enter <= now + 1e-9 for enter in path.enter.tolist()) for path in paths]
        assert session.update(now, make.view([0] * len(paths))).released.tolist() == expected


def test_robots_without_a_path_are_no_trouble(make):
    session = Timed().start(*make.solved(make.grid(1, 2), [[0], [1]]))
    assert session.update(0.0, make.view([0, 0])).released.tolist() == [0, 0]
