"""Execution without physics: the plan's durations, the delays that are asked for, and what means nothing is refused."""

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources
from mrpbench_tests.instances.roadmaps import two_way_grid

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.dispatchers.timed import Timed
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.checking.recording import check_recording
from mrpbench_core.config.delays import Delays
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording
from mrpbench_core.testing.drawing import build, path_through

PERIOD = 0.25


@pytest.fixture
def straight():
    """A robot that goes ten cells along a row."""
    grid = two_way_grid(1, 11)
    plan = Plan(paths=(path_through(grid, range(11)),))
    return attrs.evolve(build(grid, [0], [()]), goals=(((10,),),)), plan


def executed(context, dispatcher, delays=None, limit=3000.0):
    """Whether all arrived, when, and the channels."""
    chunks = []
    recorder = Recorder(1 / PERIOD, PERIOD, chunks.append)
    stream = DelayStream(delays or Delays(), len(context.problem), Seeds(3))
    result = ScheduleLoop(Schedule(context, dispatcher), stream, limit, recorder).run()
    names = {name for chunk in chunks for name in chunk}
    return (
        result.succeeded,
        result.simulated_s,
        {name: np.concatenate([c[name] for c in chunks if name in c]) for name in names},
    )


@pytest.fixture
def crossing():
    """A robot that crosses a row behind another one, which the plan lets pass first although it comes from far away."""
    grid = two_way_grid(9, 9)
    first, second = [9 * row + 6 for row in range(9)], [9 * 6 + column for column in range(9)]
    plan = Plan(paths=(path_through(grid, first), path_through(grid, [second[0]] * 4 + second)))
    return attrs.evolve(build(grid, [first[0], second[0]], [(), ()]), goals=(((first[-1],),), ((second[-1],),))), plan


def test_with_speed_profiles_robots_come_as_early_and_stand_less(context_of, crossing):
    context = context_of(*crossing)
    late = Delays(speed=0.0)
    standing, seconds, recorded = {}, {}, {}
    for profiles in (False, True):
        arrived, seconds[profiles], recorded[profiles] = executed(
            context, Adg(speed_profiles=profiles, speed_margin=0), late
        )
        assert arrived
        truth = recorded[profiles]["truth"][:, 1, :2]
        under_way = recorded[profiles]["reached"][1:, 1] < len(crossing[1].paths[1])
        standing[profiles] = int(((np.diff(truth, axis=0) == 0).all(axis=1) & under_way).sum())
    assert seconds[True] <= seconds[False] + 2 * PERIOD
    assert standing[True] < 0.5 * standing[False]
    assert "speed_limit" not in recorded[False]
    limit = recorded[True]["speed_limit"]
    assert (limit[:, 0] == np.inf).all()
    assert limit[0, 1] < np.inf
    assert limit[-1, 1] == np.inf


def test_a_robot_alone_takes_the_time_of_its_plan_and_of_its_stops(context_of, straight):
    problem, plan = straight
    context = context_of(problem, plan)
    planned = 10 * problem.roadmap.tick
    assert executed(context, Adg())[:2] == (True, pytest.approx(planned))
    delays = Delays(p_delay=0.2, max_delay=3)
    end = planned
    for begin, until in DelayStream(delays, 1, Seeds(3)).stops(0):
        if begin >= end:
            break
        end += until - begin
    assert end > planned
    assert executed(context, Adg(), delays)[:2] == (True, pytest.approx(end))


def test_a_robot_takes_each_segment_at_its_speed(context_of, straight):
    problem, plan = straight
    delays = Delays(speed=0.5)
    drawn = DelayStream(delays, 1, Seeds(3))
    expected = sum(
        problem.roadmap.tick / float(drawn.speed(np.array([0]), np.array([segment]))[0]) for segment in range(10)
    )
    seconds = executed(context_of(problem, plan), Adg(), delays)[1]
    assert expected <= seconds + 1e-9 < expected + PERIOD + 1e-9


SEEDS = st.integers(0, 2**32 - 1)


@settings(deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(SEEDS, st.booleans())
def test_plans_drain_under_delays_and_footprints_keep_apart(context_of, seed, resources):
    problem, plan = (random_plan_with_resources if resources else random_plan)(np.random.default_rng(seed))
    context = context_of(problem, plan)
    try:
        arrived, _, channels = executed(context, Adg(), Delays(p_delay=0.05, max_delay=8, speed=0.2))
    except DispatchError:
        return
    assert arrived
    if Feature.FOOTPRINTS in problem.features and problem.rules.at_goal == "stay":
        assert not len(channels["contact"])


@settings(deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(SEEDS)
def test_without_delays_a_plan_by_its_clock_takes_the_time_of_the_plan(context_of, seed):
    problem, plan = random_plan(np.random.default_rng(seed))
    arrived, seconds, _ = executed(context_of(problem, plan), Timed())
    moves = [int(path.leave[path.edge >= 0].max(initial=0)) for path in plan.paths]
    assert arrived
    assert seconds == pytest.approx(max(moves) * problem.roadmap.tick, abs=PERIOD + 1e-6)


def test_robots_that_rotate_keep_in_step(context_of):
    grid = two_way_grid(2, 3)
    routes = [(2, 1, 4), (4, 4, 3), (3, 3, 0), (0, 0, 1)]
    problem = build(grid, [route[0] for route in routes], [()] * 4)
    problem = attrs.evolve(problem, goals=tuple(((route[-1],),) for route in routes), radius=np.full(4, 0.33))
    plan = Plan(paths=tuple(path_through(grid, route) for route in routes))
    assert check_plan(problem, plan).valid
    context = context_of(problem, plan)
    for p_delay in (0.0, 0.2, 0.5):
        arrived, _, channels = executed(context, Adg(), Delays(p_delay=p_delay, max_delay=3, tick=0.5))
        assert arrived
        assert not len(channels["contact"])


def test_robots_that_are_sent_through_one_another_are_recorded_as_contacts(context_of):
    grid = two_way_grid(1, 5)
    paths = (path_through(grid, (0, 1, 2, 3, 4)), path_through(grid, (4, 3, 2, 1, 0)))
    problem = attrs.evolve(build(grid, [0, 4], [(), ()]), goals=(((4,),), ((0,),)))
    channels = executed(context_of(problem, Plan(paths=paths)), AllAtOnce())[2]
    assert channels["contact"].tolist()
    assert {tuple(pair) for pair in channels["contact"].tolist()} == {(0, 1)}


def test_the_run_ends_at_its_limit(context_of, straight):
    assert executed(context_of(*straight), Adg(), Delays(p_delay=1), limit=5.0)[:2] == (False, 5.0)


STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 3}, "planner": "prioritized"}
STUDY |= {"assigner": "identity", "execution": "schedule_only", "control_rate": 2}


def test_a_run_is_recorded_and_measured_as_far_as_that_means_something(tmp_path):
    pytest.importorskip("mrpbench_planners_mapf")
    (point,) = load_study(STUDY | {"metrics": ["execution", "tracking"]}).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None)
    assert record.status == "succeeded"
    assert record.metrics["execution.duration_s"] > 5
    assert record.metrics["execution.robot_contacts"] == 0
    channels = Recording(paths.recording).channels
    assert {"truth", "released", "reached", "cleared", "waits_for"} <= set(channels)
    assert not {"estimate", "odometry", "command"} & set(channels)


def test_draws_are_those_of_their_streams_and_the_first_is_the_run_without_them(tmp_path):
    pytest.importorskip("mrpbench_planners_mapf")
    late = {"p_delay": 0.05, "max_delay": 8, "speed": 0.2}
    channels, metrics = {}, {}
    for draws in (1, 2, 4):
        (point,) = load_study(STUDY | {"metrics": ["draws"], "delays": late | {"draws": draws}}).runs
        paths = RunPaths(recording=tmp_path / f"{draws}.zip", exports=tmp_path / "exports")
        record = execute(point.config, "run", paths, lambda stage, facts: None)
        assert record.status == "succeeded"
        recording = Recording(paths.recording)
        channels[draws] = {name: load() for name, load in recording.channels.items()}
        metrics[draws] = record.metrics
        assert not check_recording(channels[draws], recording.context().fleet)
        recording.close()
    drawn = {name for name in channels[2] if name.startswith("draw")}
    assert drawn == {"draw", "draw_arrival", "draw_waiting"}
    for name, rows in channels[1].items():
        np.testing.assert_array_equal(channels[4][name], rows)
    for name in drawn:
        np.testing.assert_array_equal(channels[4][name][:2], channels[2][name])
    arrival = channels[4]["draw_arrival"]
    assert arrival[0].max() == channels[1]["time"][-1]
    assert len(np.unique(arrival, axis=0)) == 4
    assert metrics[1]["draws.makespan_mean_s"] is None
    assert metrics[4]["draws.makespan_mean_s"] == pytest.approx(arrival.max(axis=1).mean())


@settings(deadline=None, max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(SEEDS)
def test_robots_arrive_when_they_do_in_the_recording_and_also_without_one(context_of, seed):
    problem, plan = random_plan(np.random.default_rng(seed))
    context, late = context_of(problem, plan), Delays(p_delay=0.05, max_delay=8, speed=0.2)
    loops = []
    for recorder in (Recorder(1 / PERIOD, PERIOD, (chunks := []).append), None):
        delays = DelayStream(late, len(problem), Seeds(seed), (2,))
        loops.append(ScheduleLoop(Schedule(context, Adg()), delays, 3000.0, recorder))
        assert loops[-1].run().succeeded
    np.testing.assert_array_equal(loops[0].arrival, loops[1].arrival)
    np.testing.assert_array_equal(loops[0].waiting, loops[1].waiting)
    reached = np.concatenate([chunk["reached"] for chunk in chunks if "reached" in chunk])
    time = np.concatenate([chunk["time"] for chunk in chunks if "time" in chunk])
    last = np.array([route.last_move for route in context.routes])
    np.testing.assert_array_equal(loops[0].arrival[0], time[(reached >= last).argmax(axis=0)])


def test_draws_mean_nothing_with_physics():
    with pytest.raises(InputErrors, match=r"delays\.draws: needs `execution: schedule_only`"):
        load_study(STUDY | {"execution": "simulated", "delays": {"p_delay": 0.1, "draws": 2}})


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("simulator", "kinematic"),
        ("navigator", "waypoints"),
        ("controller", "pure_pursuit"),
        ("localizer", "odometry"),
        ("plan_filter", "mrp_bench_stairs"),
        ("noise", {"lidar": 0.1}),
        ("replanning", {"period": 5}),
    ],
)
def test_what_needs_physics_is_refused(key, value):
    with pytest.raises(InputErrors, match=f"{key}: means nothing in `execution: schedule_only`"):
        load_study(STUDY | {key: value})


def test_something_must_release_the_plan():
    with pytest.raises(InputErrors, match="dispatcher"):
        load_study(STUDY | {"dispatcher": "none"})
