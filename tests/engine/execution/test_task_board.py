"""Tasks are neither lost, nor done twice, nor done by two robots, whatever order things happen in."""

from collections import Counter

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.engine.execution.task_board import TaskBoard
from mrpbench_core.model.planning.scenario import Task

ROBOTS, NAN = 3, float("nan")


def task(index, errands=1, service=0.0):
    return Task(goals=np.zeros((errands, 3)), levels=[0] * errands, service=[service] * errands, index=index)


steps = st.lists(
    st.one_of(
        st.tuples(st.just("release"), st.integers(1, 3), st.sampled_from([0.0, 2.0])),
        st.tuples(st.just("assign"), st.randoms(use_true_random=False), st.none()),
        st.tuples(st.just("rest"), st.integers(0, ROBOTS - 1), st.none()),
        st.tuples(st.just("leave"), st.integers(0, ROBOTS - 1), st.none()),
    ),
    max_size=60,
)


def act(board, released, now, step):
    """Do one of the `steps`; tasks are appended to `released`."""
    kind, value, service = step
    if kind == "release":
        released.append(task(len(released), value, service))
        board.release(float(now), released[-1], ({0: NAN},) * value)
    elif kind == "assign":
        pool = board.unbegun()
        value.shuffle(pool)
        queues = [[] for _ in range(ROBOTS)]
        for index in pool:
            if (robot := value.randrange(ROBOTS + 1)) < ROBOTS:
                queues[robot].append(index)
        board.assign(float(now), tuple(map(tuple, queues)))
    elif board.current(value) is not None:
        board.rest(float(now), value) if kind == "rest" else board.leave(value)


@settings(max_examples=100, deadline=None)
@given(steps)
def test_robots_whose_errands_ahead_change_are_named(steps):
    board, released = TaskBoard(ROBOTS), []
    ahead = [[]] * ROBOTS
    for now, step in enumerate(steps):
        board.changed.clear()
        act(board, released, now, step)
        before, ahead = ahead, [[(index, board.jobs[index].errand) for index in queue] for queue in board.queues]
        assert board.changed == {robot for robot in range(ROBOTS) if ahead[robot] != before[robot]}


@settings(max_examples=100, deadline=None)
@given(steps)
def test_every_task_is_done_once_by_the_robot_that_began_it(steps):
    board, released = TaskBoard(ROBOTS), []
    for now, step in enumerate(steps):
        act(board, released, now, step)
    events = {index: [event for event in board.events if event.task == index] for index in range(len(released))}
    done = [index for index, own in events.items() if own[-1].kind == "done"]
    assert len(done) + len(board.jobs) == len(released)
    assert board.finished == len(done)
    for index, own in events.items():
        count = Counter(event.kind for event in own)
        assert count["released"] == 1
        assert count["begun"] <= 1
        assert count["done"] == (index in done)
        assert count["errand"] == len(released[index].goals) if index in done else count["errand"] >= 0
        begun = [place for place, event in enumerate(own) if event.kind == "begun"]
        if begun:  # from then on it is one robot's
            assert len({event.robot for event in own[begun[0] :]}) == 1
            assert not {"assigned", "withdrawn"} & {event.kind for event in own[begun[0] :]}
        errands = [event.errand for event in own if event.kind == "errand"]
        assert errands == [*range(len(errands))]


def test_an_errand_takes_its_service_time_and_begins_again_when_the_robot_was_pushed_away():
    board = TaskBoard(1)
    board.release(0.0, task(0, service=2.0), ({0: NAN},))
    board.assign(0.0, ((0,),))
    assert [board.rest(now, 0) for now in (1.0, 2.0)] == [False, False]
    board.leave(0)
    assert [board.rest(now, 0) for now in (2.9, 4.8, 4.9)] == [False, False, True]
    assert board.events[-1].kind == "done"
