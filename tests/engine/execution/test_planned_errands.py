from mrpbench_core.engine.execution.planned_errands import PlannedErrands

A, B, C = (0, 0), (0, 1), (1, 0)


def planned(*errands, done=lambda errand: False):
    kept = PlannedErrands(1)
    kept.ask([errands])
    kept.adopt([errands], done)
    return kept


def test_a_path_is_right_while_what_is_ahead_is_wanted_first():
    kept = planned(A, B)
    assert kept.others([(A, B)]) == []
    assert kept.others([(A, B, C)]) == [], "the robot goes on from B with a later plan"
    assert kept.others([(A, C)]) == kept.others([(B,)]) == kept.others([()]) == [0]
    assert kept.visit(0) == A
    assert kept.others([(B, C)]) == []
    assert kept.others([(A, B)]) == [0]
    assert kept.ahead == [(B,)]
    assert kept.gone.tolist() == [1]


def test_what_was_done_while_the_planner_planned_is_not_ahead():
    kept = planned(A, B, C, done=lambda errand: errand == A)
    assert kept.ahead == [(B, C)]
    assert kept.gone.tolist() == [1]
    assert kept.others([(B, C)]) == []


def test_a_robot_without_a_path_to_an_errand_needs_a_plan_when_it_has_one():
    kept = planned()
    assert kept.others([()]) == []
    assert kept.others([(A,)]) == [0]


def test_a_robot_whose_errands_are_dropped_needs_a_plan():
    kept = planned(A, B)
    kept.drop(0)
    assert kept.others([(A, B)]) == [0]
