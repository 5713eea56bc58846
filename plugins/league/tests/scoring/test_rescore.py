"""Outputs by hand, right ones and each kind of wrong one, on a map of 3 x 4 cells."""

import attrs
import numpy as np
import pytest
from mrpbench_league.files.motion import Motion
from mrpbench_league.files.output import LorrOutput
from mrpbench_league.files.problem import LorrProblem
from mrpbench_league.scoring.rescore import rescore

BLOCKED = np.zeros((3, 4), bool)
BLOCKED[1, 2] = True


def problem(season, start, tasks, reveal=1.0, **others):
    first = np.cumsum([0, *map(len, tasks)]).astype(np.int32)
    cells = np.array([cell for task in tasks for cell in task], np.int32)
    return LorrProblem(
        season=season, blocked=BLOCKED, start=np.array(start), errands=cells, first=first, reveal=reveal, **others
    )


def output(season, start, texts, **others):
    motion = tuple(Motion(np.frombuffer(text.encode(), np.uint8)) for text in texts)
    places = [(cell // 4, cell % 4, 0) for cell in start]
    return LorrOutput(season=season, start=places, makespan=len(texts[0]), motion=motion, **others)


def faults(score):
    return [str(fault) for fault in score.faults.kept]


def test_goals_of_2023_count_whatever_the_heading_and_waiting_counts_too():
    score = rescore(problem(2023, [0, 8], [[1], [8], [3], [9]]), output(2023, [0, 8], ["FFF", "WFW"]))
    assert faults(score) == []
    assert score.tasks == 4
    expected = [(0, 0, 0, 0), (0, 1, 1, 0), (1, 0, 0, 1), (1, 1, 1, 1), (1, 0, 2, 0), (1, 1, 3, 0), (2, 1, 3, 1)]
    expected += [(2, 1, 4, 0), (3, 0, 2, 1), (3, 0, 5, 0)]
    assert score.done.events == expected  # lines repeat: task 4 is line (2 * 2 + 1) % 4, cell 8


@pytest.mark.parametrize(
    ("start", "texts", "message"),
    [
        ([0, 8], ["CF", "WW"], "time 2: robot 0 leaves the map"),
        ([5, 8], ["F", "W"], "time 1: robot 0 is in the wall at cell 6"),
        ([3, 8], ["F", "W"], "time 1: robot 0 leaves the map"),  # no wrap to the next row
        ([0, 1], ["F", "W"], "time 1: vertex conflict: robots 0 and 1 are in cell 1"),
        ([0, 1], ["WWF", "RRF"], "time 3: edge conflict: robots 0 and 1 swap their cells"),
    ],
)
def test_motion_in_steps_that_breaks_a_rule(start, texts, message):
    assert message in faults(rescore(problem(2023, start, [[11]]), output(2023, start, texts)))


def test_following_and_rings_are_legal_in_steps():
    start = [0, 1, 5, 4]
    ring = output(2023, start, ["WWF", "RWF", "RRF", "CWF"])
    assert faults(rescore(problem(2023, start, [[11]]), ring)) == []


def pool(**others):
    """Two robots, three visible tasks, and an output that opens and finishes some of them."""
    given = problem(2024, [0, 8], [[1, 3], [9], [2], [10]], reveal=1.5)
    schedule = (((1, 0),), ((1, 1), (2, 2)))
    return given, output(2024, [0, 8], ["FFFW", "FWWW"], **{"schedule": schedule, **others})


def test_a_pool_of_2024_is_followed():
    score = rescore(*pool())
    assert faults(score) == []
    assert (score.tasks, score.errands) == (2, 3)
    assert score.done.events == [(1, 0, 0, 1), (1, 1, 1, 1), (3, 0, 0, 2)]
    assert score.done.revealed == [(0, 0), (1, 0), (2, 0), (3, 1), (0, 3)]


@pytest.mark.parametrize(
    ("schedule", "message"),
    [
        ((((1, 0),), ((1, 0),)), "time 1: task 0 is given to robots 0 and 1"),
        ((((1, 0), (2, 2)), ((1, 1),)), "time 2: robot 0 drops task 0, which it has opened"),
        ((((1, 0),), ((1, 1), (2, 1))), "time 2: robot 1 is given task 1, which is finished"),
        ((((1, 9),), ((1, 1),)), "time 1: robot 0 is given task 9, which is not revealed"),
        ((((1, 3),), ((1, 1),)), "time 1: robot 0 is given task 3, which is not revealed"),
    ],
)
def test_an_assignment_that_breaks_a_rule(schedule, message):
    assert message in faults(rescore(*pool(schedule=schedule)))


@pytest.mark.parametrize(
    ("claim", "message"),
    [
        ({"finished": 3}, "numTaskFinished is 3, the motion finishes 2"),
        (
            {"events": ((1, 0, 0, 1), (1, 1, 1, 1))},
            "time 3: events: robot 0, task 0, errands done 2: happens but is not",
        ),
        ({"tasks": ((0, 0, (0, 1, 0, 3)),)}, "tasks: task 1 is missing, it is (0, (2, 1)) (time of reveal, places)"),
    ],
)
def test_a_claim_that_is_wrong(claim, message):
    assert any(found.startswith(message) for found in faults(rescore(*pool(**claim))))


def ticks(texts, start, size=1.0, counter=2, **others):
    given = problem(2026, start, [[11]], counter=counter, size=size)
    return faults(rescore(given, output(2026, start, texts, counter=counter, schedule=((),) * len(start), **others)))


def test_a_train_moves_as_one_and_who_waits_until_the_cell_is_left_may_enter_round_a_corner():
    assert ticks(["FFFF", "FFFF"], [0, 1]) == []
    assert ticks(["WWWWFF", "RRFFWW"], [0, 1]) == []


@pytest.mark.parametrize(
    ("texts", "start", "message"),
    [
        (["WWFF", "RRFF"], [0, 1], "robots 0 and 1 overlap"),  # round the corner, too early
        (["FF", "WW"], [0, 1], "time 1: robots 0 and 1 overlap"),
        (["FRWW", "WWWW"], [0, 8], "time 2: robot 0 begins R within F"),
        (["FF", "WW"], [3, 8], "time 1: robot 0 drives into a wall"),
    ],
)
def test_motion_in_ticks_that_breaks_a_rule(texts, start, message):
    assert any(message in found for found in ticks(texts, start))


def test_smaller_squares_may_come_closer():
    assert ticks(["WWFF", "RRFF"], [0, 1], size=0.5) == []


def test_who_acts_while_delayed_is_found():
    found = ticks(["FF", "FF"], [0, 8], delays=(((1, 3),), ()))
    assert found == ["time 2: robot 0 acts while it is delayed from 1 to 3"]


def test_ticks_without_an_answer_are_counted_and_absent_from_the_motion():
    given = problem(2026, [0], [[1]], counter=2)
    late = output(2026, [0], ["FF"], counter=2, schedule=(((0, 0),),))
    score = rescore(given, attrs.evolve(late, makespan=12))
    assert score.done.events == [(12, 0, 0, 1)]
    assert faults(score) == []
