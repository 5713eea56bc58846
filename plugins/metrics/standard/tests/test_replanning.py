"""A new plan that changes nothing changes no metric."""

import attrs
import mrpbench_metrics_standard as ours
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core import run as run_study
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.runs.routes import with_latest_routes
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.recording import Recording
from mrpbench_core.testing.fixtures.finished_run import ROBOTS, SAMPLES, channels, context, executed

METRICS = {name: getattr(ours, name)() for name in ours.__all__}
COUNTS = ("reached", "cleared", "released")
STEPS = ((0.5, 0), (0, 0.5), (-0.5, 0), (0, -0.5), (0, 0))


def measured(run):
    return {name: dict(metric.measure(run)) for name, metric in METRICS.items()}


def drawn_run(random):
    """First context and channels of a run whose robots follow drawn paths, some with waits and some not to the end."""
    first = context()
    recorded = {name: rows.copy() for name, rows in channels().items()}
    routes = []
    for robot in range(ROBOTS):
        steps = random.choice(STEPS, random.integers(0, 7))
        place = first.routes[robot].waypoint[0, :2] + np.cumsum([(0, 0), *steps], axis=0)
        waypoint = np.column_stack([place, np.full(len(place), np.nan)])
        routes.append(Route(waypoint=waypoint, level=[0] * len(place), speed=[np.inf] * len(steps)))
        done = np.sort(random.integers(0, random.integers(len(steps) + 1) + 1, SAMPLES))
        done[0] = 0
        ahead = np.minimum(done + random.integers(0, 3, SAMPLES), len(steps))
        recorded["reached"][:, robot] = recorded["cleared"][:, robot] = done
        recorded["released"][:, robot] = np.maximum.accumulate(ahead)
        recorded["truth"][:, robot, :2] = place[done] + random.uniform(-0.2, 0.2, (SAMPLES, 2))
    return attrs.evolve(first, routes=tuple(routes)), recorded


def repeated(routes, recorded, sample, waited):
    """Repeat the plan at a sample: what is released stays, each robot of `waited` then waits, and its path goes on.

    `waited` gives for each robot the sample from which its wait counts as completed, or None if it does not wait.
    """
    changed = []
    for robot, route in enumerate(routes):
        if waited[robot] is None:
            changed.append(route)
            continue
        at = int(recorded["released"][sample, robot])
        later = np.arange(SAMPLES) >= max(sample, waited[robot])
        for name in COUNTS:
            count = recorded[name][:, robot]
            recorded[name][:, robot] = count + ((count > at) | (later & (count == at)))
        rows = np.insert(np.arange(len(route.waypoint)), at, at)
        speed = np.insert(route.speed, at, np.inf)
        changed.append(Route(waypoint=route.waypoint[rows], level=route.level[rows], speed=speed))
    return tuple(changed)


def route_channels(plans):
    """The channels `route_...` of plans [(seconds, routes), ...]."""
    rows = [
        (time, number, robot, point, level, speed)
        for number, (time, routes) in enumerate(plans, 1)
        for robot, route in enumerate(routes)
        for point, level, speed in zip(route.waypoint, route.level, [np.inf, *route.speed], strict=True)
    ]
    names = ("time", "revision", "robot", "waypoint", "level", "speed")
    return {f"route_{name}": np.array(column) for name, column in zip(names, zip(*rows, strict=True), strict=True)}


REPLANS = st.lists(
    st.tuples(st.integers(0, SAMPLES - 1), st.tuples(*[st.none() | st.integers(0, SAMPLES)] * ROBOTS)),
    min_size=1,
    max_size=4,
)


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 2**32), replans=REPLANS)
def test_metrics_are_the_same_with_new_plans_that_repeat_the_old_one(seed, replans):
    first, recorded = drawn_run(np.random.default_rng(seed))
    before = measured(executed(first, {name: rows.copy() for name, rows in recorded.items()}))
    plans, routes = [], first.routes
    for sample, waited in sorted(replans, key=lambda replan: replan[0]):
        routes = repeated(routes, recorded, sample, waited)
        plans.append((recorded["time"][sample], routes))
    recorded |= route_channels(plans)
    after = executed(first, recorded)
    after = attrs.evolve(after, context=with_latest_routes(first, after.channels))
    assert measured(after) == before


def test_a_robot_that_makes_way_after_its_arrival_arrives_when_it_is_back():
    first, recorded = context(), channels()
    there = [(0, 0), (1, 0), (1, 0), (1, 1), (1, 0)]  # arrives, waits, makes way, comes back
    waypoint = np.array([(x, y, np.nan) for x, y in there])
    away = Route(waypoint=waypoint, level=[0] * 5, speed=[np.inf] * 4)
    recorded["reached"][:, 0] = np.repeat([0, 1, 2, 3, 4], [10, 5, 5, 10, 11])
    recorded |= route_channels([(1.0, (away, *first.routes[1:]))])
    recorded["reached"][:, 1:] = 2
    del recorded["mode"]  # of other fleets: where robots are at the end does not count
    run = executed(first, recorded)
    for end, expected in ((SAMPLES, 3.0), (SAMPLES - 11, None)):
        cut = {name: load()[:end] if len(load()) == SAMPLES else load() for name, load in run.channels.items()}
        shown = executed(with_latest_routes(first, run.channels), cut)
        assert METRICS["Execution"].measure(shown)["duration_s"] == expected
        assert METRICS["Delay"].measure(shown)["robots"] == (3 if expected else 2)


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """Records and true poses of one run, without and with a new plan every two seconds."""
    setting = {"world": "office", "scenario": {"plugin": "random", "robots": 3}, "planner": "prioritized", "seed": 5}
    setting |= {"metrics": ["execution", "clearance", "deadlock", "delay", "efficiency", "stops", "tracking"]}
    setting["metrics"] += ["contact", "fairness", "smoothness", "throughput"]
    found = []
    for changes in ({}, {"replanning": {"period": "2 s"}}):
        out = tmp_path_factory.mktemp("run")
        (record,) = run_study({**setting, **changes}, out=out)
        recording = Recording(ResultsFolder(out).run(record["run_id"]).recording)
        found.append((record, recording.channel("truth"), recording.channel("event_kind").tolist()))
        recording.close()
    return found


def test_a_run_with_new_plans_and_the_same_motion_has_the_same_metrics(pair):
    (without, truth, _), (record, same, events) = pair
    assert events.count("replan") > 5
    assert truth.tolist() == same.tolist()
    assert record["status"] == without["status"] == "succeeded"
    assert record["metrics"] == without["metrics"]
