import attrs
import pytest

from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce


@pytest.fixture(scope="module")
def crossing(make):
    return make.solved(make.grid(2, 3), [[0, 1, 2], [3, 4], [5, 4, 4, 1]])


def test_everything_is_released_at_once(make, crossing):
    session = AllAtOnce().start(*crossing)
    assert session.update(0.0, make.view([0, 0, 0])).released.tolist() == [2, 1, 3]


def test_stagger_counts_from_the_first_update_and_from_robot_to_robot(make, crossing):
    session = AllAtOnce(stagger=2.5).start(*crossing)
    seen = [session.update(now, make.view([0, 0, 0])).released.tolist() for now in (10.0, 12.4, 12.5, 15.0)]
    assert seen == [[2, 0, 0], [2, 0, 0], [2, 1, 0], [2, 1, 3]]


def test_a_new_plan_reaches_only_the_robots_whose_turn_has_come(make, crossing):
    problem, plan = crossing
    session = AllAtOnce(stagger=2.5).start(problem, plan)
    session.update(0.0, make.view([0, 0, 0]))
    session.adopt(*make.solved(make.grid(2, 3), [[0, 1, 2, 2, 2], [3, 4], [5, 4]]))
    assert session.update(1.0, make.view([0, 0, 0], revision=1)).released.tolist() == [4, 0, 0]
    assert session.update(5.0, make.view([0, 0, 0], revision=1)).released.tolist() == [4, 1, 1]


def test_commitments_stay_released(make, crossing):
    _, plan = crossing
    problem, longer = make.solved(make.grid(2, 3), [[0, 1, 2, 2], [3, 4], [5, 4, 4, 1]])
    session = AllAtOnce(stagger=1.0).start(attrs.evolve(problem, commitments=plan.paths), longer)
    assert session.update(0.0, make.view([0, 0, 0])).released.tolist() == [3, 1, 3]


def test_a_negative_stagger_is_refused():
    with pytest.raises(ValueError, match="stagger"):
        AllAtOnce(stagger=-1.0)
