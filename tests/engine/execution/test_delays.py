"""Delays of robots: of the model asked for, repeatable, the same for all planners, and seen in executions."""

from itertools import islice

import numpy as np
import pytest

from mrpbench_core.config.delays import Delays
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording


def stopped(settings, robots, ticks, seed=0):
    """bool[ticks, robots], and the stops that began as (tick, robot, length)."""
    delays, rows, begun = DelayStream(settings, robots, Seeds(seed, 0)), [], []
    for tick in range(ticks):
        begun += [(tick, event.robot, float(event.detail.removesuffix(" s"))) for event in delays.begun(float(tick))]
        rows.append(delays.stopped.copy())
    return np.array(rows), begun


def literal(settings, robots, ticks, seed):
    """The model as the League of Robot Runners states it, tick by tick."""
    random, left, rows = np.random.default_rng(seed), np.zeros(robots, int), []
    for _ in range(ticks):
        left = np.maximum(left - 1, 0)
        free = np.flatnonzero(left == 0)
        if settings.event_model == "bernoulli":
            hit = free[random.random(len(free)) < settings.p_delay]
        else:
            hit = random.choice(free, min(random.poisson(robots * settings.p_delay), len(free)), replace=False)
        least, most = settings.min_delay, settings.max_delay
        length = random.integers(least, most + 1, len(hit))
        if settings.duration_model == "gaussian":
            mean, std = least + (most - least) * settings.gauss_mean_ratio, (most - least) * settings.gauss_std_ratio
            length = np.clip(np.round(random.normal(mean, std, len(hit))), least, most)
        left[hit] = length
        rows.append(left > 0)
    return np.array(rows)


@pytest.mark.parametrize("event_model", ["bernoulli", "poisson"])
@pytest.mark.parametrize("duration_model", ["uniform", "gaussian"])
def test_stops_are_distributed_as_those_of_the_model_tick_by_tick(event_model, duration_model):
    settings = Delays(p_delay=0.1, min_delay=2, max_delay=9, event_model=event_model, duration_model=duration_model)
    ours, theirs = stopped(settings, 20, 3000)[0], literal(settings, 20, 3000, 1)
    assert ours.mean() == pytest.approx(theirs.mean(), abs=0.015)
    for statistic in (
        lambda rows: (rows[1:] & ~rows[:-1]).mean(),  # robots that begin to stop
        lambda rows: (rows[9:] & rows[:-9]).mean(),  # lengths
        lambda rows: rows.mean(axis=1).std(),  # how many stop at a time
    ):
        assert statistic(ours) == pytest.approx(statistic(theirs), rel=0.12)


def test_the_share_of_time_lost_is_that_of_the_formula():
    settings = Delays(p_delay=0.05, min_delay=1, max_delay=10)
    expected = 0.05 * 5.5 / (1 - 0.05 + 0.05 * 5.5)
    assert stopped(settings, 40, 2000)[0].mean() == pytest.approx(expected, rel=0.05)


def test_events_say_when_stops_begin_and_how_long_they_are():
    rows, begun = stopped(Delays(p_delay=0.2, max_delay=4), 5, 200)
    expected = np.zeros((400, 5), bool)
    for tick, robot, length in begun:
        assert not expected[tick, robot]
        expected[tick : tick + int(length), robot] = True
    np.testing.assert_array_equal(rows, expected[:200])


def test_all_robots_stop_all_the_time_if_that_is_certain():
    assert stopped(Delays(p_delay=1), 3, 50)[0].all()


def test_the_stops_of_a_robot_follow_seed_repeat_and_robot_and_nothing_else():
    settings = Delays(p_delay=0.1, speed=0.3)
    few, many = DelayStream(settings, 2, Seeds(3, 0)), DelayStream(settings, 9, Seeds(3, 0))
    assert [*islice(few.stops(1), 20)] == [*islice(many.stops(1), 20)]
    both, late = np.arange(2), np.array([3, 200])
    near = few.speed(both, np.array([1, 5]))
    np.testing.assert_array_equal(many.speed(both, late), few.speed(both, late))
    np.testing.assert_array_equal(few.speed(both, np.array([1, 5])), near)
    others = [DelayStream(settings, 2, Seeds(*key)) for key in ((4, 0), (3, 1))]
    assert (
        len({tuple(islice(DelayStream(settings, 2, Seeds(*key)).stops(0), 20)) for key in ((3, 0), (4, 0), (3, 1))})
        == 3
    )
    assert all((other.speed(both, late) != few.speed(both, late)).all() for other in others)


def test_a_tick_is_as_long_as_asked_for():
    seconds, halves = (DelayStream(Delays(p_delay=0.2, tick=tick), 1, Seeds(0, 0)) for tick in (1.0, 0.5))
    for one, half in islice(zip(seconds.stops(0), halves.stops(0), strict=True), 20):
        assert (one[0] / 2, one[1] / 2) == half


def test_speeds_are_log_normal_with_mean_one():
    delays = DelayStream(Delays(speed=0.3), 200, Seeds(0, 0))
    drawn = np.concatenate([delays.speed(np.arange(200), np.full(200, segment)) for segment in range(100)])
    assert drawn.mean() == pytest.approx(1, abs=0.01)
    assert np.log(drawn).std() == pytest.approx(0.3, rel=0.03)
    assert not delays.stopped.any()
    assert (delays.driven(np.ones((200, 2)), np.zeros(200, int)) > 0).all()


def test_without_delays_commands_pass_unchanged():
    delays, twist = DelayStream(Delays(), 2, Seeds(0, 0)), np.ones((2, 2))
    assert not delays
    assert not [*delays.begun(9.0)]
    assert delays.driven(twist, np.zeros(2, int)) is twist


def driven(tmp_path, name, simulator, **delays):
    """The recording of two robots in the office."""
    study = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "prioritized"}
    study |= {"assigner": "identity", "simulator": simulator, "delays": delays, "control_rate": 5}
    study |= {"fleet": [{"robot": "turtlebot3_burger", "lidar": "none"}], "limits": {"execution": 400}}
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / f"{name}.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None)
    assert record.status == "succeeded", record.error
    return Recording(paths.recording).channels


@pytest.mark.parametrize("simulator", ["planar"])
def test_robots_stand_while_they_stop_and_arrive_later(tmp_path, simulator):
    punctual = driven(tmp_path, "punctual", simulator)
    late = driven(tmp_path, "late", simulator, p_delay=0.05, min_delay=3, max_delay=6)
    time, speed = late["time"](), np.abs(late["truth_twist"]())
    columns = (late[f"event_{name}"]() for name in ("kind", "time", "robot", "detail"))
    events = zip(*columns, strict=True)
    stops = [(at, robot, float(detail.removesuffix(" s"))) for kind, at, robot, detail in events if kind == "delay"]
    assert stops
    for at, robot, length in stops:
        within = (time > at + 1) & (time < at + length)
        assert (speed[within, robot] < 1e-6).all()
    assert time[-1] > punctual["time"]()[-1] + 2
