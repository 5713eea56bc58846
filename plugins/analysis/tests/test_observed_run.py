"""Runs that are known from positions only."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_analysis.observed_run import Sampling, observe, observe_recording
from mrpbench_analysis.resampling import even_times, resample

from mrpbench_core.api.format import Observed, Track
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet, RobotModel
from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.worlds.world import Level, World

NAN = float("nan")
DISC = RobotModel(name="disc", footprint=[[0.1, 0], [0, 0.1], [-0.1, 0]], max_speed=1, max_turn_rate=1)
HOUSE = World(name="house", levels=(Level(name="L1"), Level(name="L2", elevation=4.0)))


def track(time, x, robot="a", **more):
    time = np.array(time, float)
    pose = np.column_stack([x, np.zeros(len(time)), np.zeros(len(time))])
    height = more.pop("height", np.full(len(time), NAN))
    return Track(robot=robot, source="tf", topic="/tf", time=time, pose=pose, height=height, **more)


def scenario(*goals, levels=None, starts=1):
    task = Task(goals=[[x, 0, NAN] for x in goals], levels=levels or [0] * len(goals))
    return Scenario(start=[[0, 0, 0]] * starts, start_level=[0] * starts, tasks=(task,))


def seen(found, tracks, world=None, complete=True, **sampling):
    world = world or attrs.evolve(HOUSE, levels=HOUSE.levels[:1])
    fleet = Fleet(robots=(DISC,) * len(found.start))
    return observe(Observed(tracks=tuple(tracks), complete=complete), world, fleet, found, Sampling(**sampling))


@settings(deadline=None, max_examples=60)
@given(begin=st.floats(-1e3, 1e3), span=st.floats(0.01, 100), rate=st.floats(0.5, 50))
def test_times_are_even_and_end_at_the_end(begin, span, rate):
    times = even_times(begin, begin + span, rate)
    assert times[0] == begin
    assert times[-1] == pytest.approx(begin + span, abs=2e-6)
    steps = np.diff(times)
    assert steps[:-1] == pytest.approx(np.full(max(0, len(steps) - 1), 1 / rate), abs=1e-9)
    assert (steps > 0).all()


def test_samples_are_kept_and_others_are_interpolated_linearly():
    drive = track([0, 1, 2], [0, 2, 3])
    found = resample(drive, np.array([0, 0.5, 1, 1.25, 2]), 5)
    assert found.pose[:, 0].tolist() == [0, 1, 2, 2.25, 3]
    assert (found.notes, found.gaps) == ((), ())


def test_headings_take_the_short_way():
    turn = attrs.evolve(track([0, 1], [0, 0]), pose=np.array([[0, 0, 3.0], [0, 0, -3.0]]))
    (_, middle, _) = resample(turn, np.array([0, 0.5, 1]), 5).pose[:, 2]
    assert np.cos(middle) == pytest.approx(-1)


@pytest.mark.parametrize(("moved", "unknown"), [(0.2, 0), (0.3, 29)])
def test_a_gap_hides_only_robots_that_moved(moved, unknown):
    found = resample(track([0, 1, 4, 5], [0, 0, moved, moved]), np.arange(0, 5.05, 0.1), 2)
    assert np.isnan(found.pose[:, 0]).sum() == unknown
    assert len(found.gaps) == (unknown > 0)


def test_goals_are_reached_in_their_order():
    time = np.arange(0, 10.05, 0.1)
    away_and_back = np.where(time < 5, time, 10 - time)
    found = seen(scenario(4.0, 1.0), [track(time, away_and_back)])
    reached = found.channels["reached"][:, 0]
    assert time[np.argmax(reached == 1)] == pytest.approx(3.8)  # 0.25 m before it, at a sample
    assert time[np.argmax(reached == 2)] == pytest.approx(8.8)  # not on the way out
    assert found.context.goal == ((1.0, 0.0, pytest.approx(NAN, nan_ok=True)),)


def test_a_robot_without_a_task_is_where_it_should_be():
    found = seen(scenario(4.0, starts=2), [track([0, 9], [0, 4]), track([0, 9], [0, 0], robot="b")])
    assert [len(route.speed) for route in found.context.routes] == [1, 0]
    assert found.channels["reached"][-1].tolist() == [1, 0]
    assert found.context.assigned == (0, -1)


@pytest.mark.parametrize("more", [{"levels": ("L1",) * 3 + ("L2",) * 2}, {"height": np.array([0, 0.1, 0.2, 4.0, 4.1])}])
def test_levels_are_told_by_name_or_height(more):
    found = seen(scenario(4.0, levels=[1]), [track(range(5), range(5), **more)], HOUSE, rate=1)
    assert found.channels["level"][:, 0].tolist() == [0, 0, 0, 1, 1]
    assert found.channels["reached"][:, 0].tolist() == [0, 0, 0, 0, 1]
    downstairs = seen(scenario(4.0), [track(range(5), range(5), **more)], HOUSE, rate=1)
    assert not downstairs.channels["reached"].any()


@pytest.mark.parametrize("more", [{}, {"levels": ("ground floor",) * 5}])
def test_levels_that_nothing_tells_are_no_channel(more):
    found = seen(scenario(4.0), [track(range(5), range(5), **more)], HOUSE)
    assert "level" not in found.channels
    assert "levels" in found.notes[-1]


def test_a_robot_that_begins_elsewhere_is_suspicious():
    found = seen(scenario(4.0), [track([0, 1], [2.5, 4])])
    assert found.notes == ("a is first seen 2.5 m from the start of the scenario's robot 0",)


@pytest.mark.parametrize(
    ("sampling", "message"),
    [({"since": 5.0, "until": 4.0}, "nothing is recorded from 5 to 4 s"), ({"rate": 1e7}, "too many samples")],
)
def test_impossible_samplings_are_refused(sampling, message):
    with pytest.raises(InputError, match=message):
        seen(scenario(4.0), [track([0, 9], [0, 4])], **sampling)


def test_few_poses_over_a_long_time_are_refused_before_memory_is_taken():
    with pytest.raises(InputError, match="too many samples"):
        seen(scenario(4.0), [track([0, 1, 150_000], [0, 1, 4])])


def test_tasks_of_an_online_scenario_are_refused():
    late = attrs.evolve(scenario(4.0), tasks=(Task(goals=[[4, 0, NAN]], release=3.0),))
    with pytest.raises(InputError, match="released over time"):
        seen(late, [track([0, 9], [0, 4])])


def test_the_problem_has_the_starts_and_the_goals_in_their_order():
    found = seen(scenario(4.0, 1.0, starts=2), [track([0, 9], [0, 4]), track([0, 9], [0, 0], robot="b")])
    problem = found.context.problem
    assert problem.roadmap.position[problem.start].tolist() == [[0, 0], [0, 0]]
    assert [problem.roadmap.position[list(places)].tolist() for places in problem.goals[0]] == [[[4, 0]], [[1, 0]]]
    assert problem.goals[1] == ()


SECONDS = np.arange(0, 10.05, 0.1)
STANDS = np.minimum(0.3 * SECONDS, 1.5)
UNSEEN = np.concatenate([SECONDS[:20], SECONDS[60:]])


@pytest.mark.parametrize(
    ("a", "more", "open_ends"),
    [
        (track(SECONDS, 0.5 * SECONDS), {"complete": False}, ()),  # at its goal, which it leaves
        (track(SECONDS, STANDS), {}, ()),
        (track(SECONDS, 0.3 * SECONDS), {}, ("a still moves when the recording ends",)),
        (track(SECONDS, np.minimum(0.3 * SECONDS, 2.5)), {"max_gap": 1.0}, ()),
        (track(SECONDS, np.minimum(0.3 * SECONDS, 2.5)), {"max_gap": 2.5}, ("a still moves when the recording ends",)),
        (track(SECONDS[:71], STANDS[:71]), {}, ("a is not seen in the last 3.0 s",)),
        (track(SECONDS[:91], STANDS[:91]), {}, ()),
        (track(UNSEEN, np.where(UNSEEN < 5, 0.0, 1.5)), {}, ("a moved unseen and may have been at its goals",)),
        (track(SECONDS, STANDS), {"complete": False}, ("the end of the recording is missing or damaged",)),
        (track(SECONDS, STANDS), {"until": 9.0}, ("the rest of the recording is cut off",)),
        (track(SECONDS, STANDS), {"until": 10.0}, ()),
    ],
)
def test_an_end_is_open_if_a_robot_is_neither_seen_at_its_goals_nor_standing(a, more, open_ends):
    other = track(SECONDS, np.zeros(len(SECONDS)), robot="b")
    assert seen(scenario(4.0, starts=2), [a, other], **more).open_ends == open_ends


@pytest.mark.parametrize(
    ("reached", "mode", "complete", "is_open"),
    [
        (1, Mode.FOLLOWING, False, False),
        (0, Mode.FOLLOWING, False, True),
        (0, Mode.ABORTED, False, False),
        (0, Mode.FOLLOWING, True, False),
    ],
)
def test_the_end_of_a_damaged_recording_of_ours_is_open_before_arrivals_and_aborts(reached, mode, complete, is_open):
    tracks = (track([0, 1], [0, 1]),)
    context = seen(scenario(1.0), tracks).context
    channels = {"time": np.array([0.0, 1.0]), "reached": np.array([[0], [reached]]), "mode": np.array([[0], [mode]])}
    found = observe_recording(Observed(tracks=tracks, channels=channels, complete=complete), context)
    assert found.open_ends == (("the end of the recording is missing or damaged",) if is_open else ())
    assert found.channels["truth"][:, 0, 0].tolist() == [0, 1]


@pytest.mark.parametrize(("heading", "end"), [(np.pi / 2, [0, 4, np.pi / 2 + 0.3]), (NAN, [3, 3, 0.5])])
def test_poses_in_a_robots_own_frame_begin_at_its_start(heading, end):
    """It moves 2 m ahead and 1 m to its left; without a heading at the start its frame is parallel to the map."""
    own = attrs.evolve(track([0, 1], [10, 12]), pose=np.array([[10, 5, 0.2], [12, 6, 0.5]]), placed=False)
    if not np.isnan(heading):
        turned = np.array([[np.cos(0.2), -np.sin(0.2)], [np.sin(0.2), np.cos(0.2)]])
        own = attrs.evolve(own, pose=np.column_stack([[[0, 0], [2, 1]] @ turned.T + [10, 5], [0.2, 0.5]]))
    found = seen(attrs.evolve(scenario(9.0), start=[[1, 2, heading]]), [own])
    assert found.channels["truth"][0, 0, :2].tolist() == pytest.approx([1, 2])
    assert found.channels["truth"][-1, 0].tolist() == pytest.approx(end)
    assert "its first pose was put at the start" in found.notes[0]
    assert len(found.notes) == 1 + np.isnan(heading)
