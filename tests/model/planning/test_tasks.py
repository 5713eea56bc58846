"""Tasks in flat arrays."""

import math

from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.model.planning.tasks import flat_tasks

NUMBERS = st.floats(0, 100)


@st.composite
def tasks(draw):
    places = draw(st.lists(st.integers(1, 3), min_size=1, max_size=3))  # of each errand
    goals = [[draw(NUMBERS), draw(NUMBERS), draw(st.sampled_from([math.nan, 1.0]))] for _ in range(sum(places))]
    return Task(
        goals=goals,
        errand=[errand for errand, count in enumerate(places) for _ in range(count)],
        levels=[0] * len(goals),
        service=[draw(NUMBERS) for _ in places],
        name=draw(st.sampled_from(["", "a"])),
        release=draw(NUMBERS),
        deadline=draw(NUMBERS),
        priority=draw(st.integers(0, 3)),
        index=draw(st.integers(0, 9)),
    )


@given(st.lists(tasks(), max_size=4))
def test_joined_tasks_are_the_same_tasks(given_tasks):
    flat = flat_tasks(given_tasks)
    assert len(flat) == len(given_tasks)
    assert repr(list(flat)) == repr(given_tasks)
    assert flat_tasks(flat) is flat
