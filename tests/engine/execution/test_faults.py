"""Faults: drawn repeatably, in force when they are drawn, and every robot's fate is definite and explained."""

import math

import attrs
import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources
from mrpbench_tests.instances.roadmaps import two_way_grid

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.config.delays import Delays
from mrpbench_core.config.faults import Fault, Faults
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.delays import DelayStream
from mrpbench_core.engine.execution.faults import FaultState, approaches, draw_faults
from mrpbench_core.engine.execution.recorder import Recorder
from mrpbench_core.engine.execution.schedule import Schedule
from mrpbench_core.engine.execution.schedule_loop import ScheduleLoop
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.runs.routing import Router
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

reordering = pytest.importorskip("mrpbench_dispatchers_reordering")
PERIOD = 0.25
GRID = two_way_grid(3, 5)
kinds = st.sampled_from(["stop", "slow", "lidar", "silent", "blocked", "out_of_order"])
entries = st.builds(
    lambda kind, at, mtbf, lasts: Fault(kind=kind, at=at, mtbf=None if at is not None else mtbf, lasts=lasts),
    kinds,
    st.none() | st.floats(0, 90),
    st.floats(20, 60),
    st.none() | st.floats(0.5, 30),
)


def drawn(events, seed=0, limit=100.0, robots=4):
    return draw_faults(Faults(events=tuple(events)), robots, GRID, ("door", "lift"), limit, Seeds(seed))


@given(st.lists(entries, min_size=1, max_size=4), st.integers(0, 2**32))
@settings(max_examples=20)
def test_each_fault_is_in_force_exactly_as_drawn(events, seed):
    found = drawn(events, seed)
    assert found == drawn(events, seed)
    state, rows = FaultState(Faults(events=tuple(events)), found, 4), []
    for now in range(125):
        rows += [(now, event) for event in state.update(now)]
        for kind, mask in (("stop", state.stopped), ("silent", state.silent)):
            expected = [
                any(e.robot == r and e.kind == kind and e.begin <= now + 1e-9 < e.end for e in found) for r in range(4)
            ]
            assert mask.tolist() == expected
        assert {e.facility for e in found if e.facility and e.begin <= now + 1e-9 < e.end} == state.broken
    assert sorted(e.begin for e in found if e.begin < 124) == sorted(e.stamp for _, e in rows if e.kind == "fault")
    assert sorted(e.end for e in found if e.end < 124) == sorted(e.stamp for _, e in rows if e.kind == "fault_over")
    assert all(-1e-9 <= seen - event.stamp < 1 for seen, event in rows)


def test_another_entry_or_robot_changes_no_draw():
    often = Fault(kind="stop", mtbf=20, lasts=5)
    alone = drawn([often])
    assert [e for e in drawn([often, Fault(kind="slow", mtbf=9)]) if e.kind == "stop"] == list(alone)
    assert [e for e in drawn([often], robots=9) if e.robot < 4] == list(alone)


def test_times_between_failures_and_to_repair_have_the_stated_means():
    found = drawn([Fault(kind="stop", mtbf=40, lasts=10)], limit=4e4)
    own = [e for e in found if e.robot == 0]
    gaps = np.diff([e.begin for e in own]) - [e.end - e.begin for e in own[:-1]]
    assert gaps.mean() == pytest.approx(40, rel=0.15)
    assert np.mean([e.end - e.begin for e in own]) == pytest.approx(10, rel=0.15)


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        (Fault(kind="stop", at=1, robot=4), "faults.events.0.robot: there is no robot 4; the fleet has 4"),
        (Fault(kind="out_of_order", at=1, facility="gate"), "there is no door or lift 'gate'"),
        (Fault(kind="blocked", at=1, place=(0, 0), level=3), "faults.events.0.level: must be below 1, got 3"),
    ],
)
def test_a_fault_of_what_does_not_exist_is_refused(fault, said):
    with pytest.raises(InputError, match=said):
        drawn([fault])


def in_force(*events):
    state = FaultState(Faults(events=events), drawn(events), 4)
    state.update(1.0)
    return state


def test_a_robot_without_lidar_scans_nothing_and_the_others_do():
    batch = ScanBatch(stamp=1.0, robot=np.array([0, 1, 3]), ranges=np.arange(6.0).reshape(3, 2))
    (left,) = in_force(Fault(kind="lidar", at=0.5, robot=1)).scans([batch])
    assert left.robot.tolist() == [0, 3]
    assert left.ranges.tolist() == [[0, 1], [4, 5]]


def test_commands_of_stopped_and_slow_robots_are_scaled():
    state = in_force(Fault(kind="stop", at=0, robot=2), Fault(kind="slow", at=0, robot=1, speed=0.25))
    assert state.driven(np.ones((4, 2)))[:, 0].tolist() == [1, 0.25, 0, 1]


def test_nothing_reaches_or_leaves_a_silent_robot():
    state = FaultState(Faults(events=(own := Fault(kind="silent", at=1, robot=0),)), drawn([own]), 4)

    def view(reached):
        there = np.full(4, reached)
        return FleetView(
            revision=0, reached=there, cleared=there, pose=np.full((4, 3), reached), level=0 * there, mode=there
        )

    state.update(0.0)
    state.reported_view(view(1))
    assert state.received(np.full(4, 2)).tolist() == [2, 2, 2, 2]
    state.update(1.0)
    assert state.reported_view(view(3)).reached.tolist() == [1, 3, 3, 3]
    assert state.reported_view(view(4)).pose[:, 0].tolist() == [1, 4, 4, 4]
    assert state.received(np.full(4, 5)).tolist() == [2, 5, 5, 5]


def test_a_lift_that_is_out_of_order_keeps_its_doors_as_they_are():
    state = in_force(Fault(kind="out_of_order", at=0, facility="lift"))
    now = {"lift": 2.0, "lift/gate": 0.5, "door": 0.0}
    assert state.held({"lift": 4.0, "lift/gate": 1.0, "door": 1.0}, now) == {"lift": 2.0, "lift/gate": 0.5, "door": 1.0}


@pytest.mark.parametrize(
    ("tail", "head", "closer"),
    [((0, 0), (2, 0), True), ((0, 0), (0.5, 0), False), ((1, 0.2), (2, 0.2), False), ((1, 0.6), (1, 0.2), True)],
)
def test_only_moves_that_lead_closer_to_a_blocked_place_are_blocked(tail, head, closer):
    found = approaches(np.array([1.0, 0.0]), np.array([tail], float), np.array([head], float), np.array([0.4]))
    assert found.tolist() == [closer]


def finished(run_context, problem, plan, faults, seed, dispatcher):
    """Execute without physics; whether all arrived, the simulated seconds, and the ending if there were faults."""
    robots = len(problem)
    router = Router(problem, np.full(robots, np.nan), np.full(len(problem.roadmap.edges), np.inf))
    start = np.column_stack([problem.roadmap.position[problem.start], np.zeros(robots)])
    scenario = attrs.evolve(run_context.scenario, start=start, start_level=np.zeros(robots))
    fleet = Fleet(robots=run_context.fleet.robots[:1] * robots)
    context = attrs.evolve(
        run_context,
        problem=problem,
        fleet=fleet,
        scenario=scenario,
        routes=router(plan),
        period=PERIOD,
        result=attrs.evolve(run_context.result, plan=plan),
    )
    names = [resource.name for resource in problem.roadmap.resources]
    events = draw_faults(faults, robots, problem.roadmap, names, 3000.0, Seeds(seed))
    state = FaultState(faults, events, robots)
    loop = ScheduleLoop(
        Schedule(context, dispatcher),
        DelayStream(DELAYS, robots, Seeds(seed)),
        3000.0,
        Recorder(1, PERIOD, lambda chunk: None),
        state,
    )
    return loop.run(), np.isnan(loop.arrival[0]), events


lasting = st.builds(
    lambda kind, at: Fault(kind=kind, at=at, radius=0.05),
    st.sampled_from(["stop", "silent", "blocked"]),
    st.floats(0, 20),
)
passing = st.builds(lambda kind, at: Fault(kind=kind, at=at, lasts=10), kinds, st.floats(0, 20))


DELAYS = Delays(p_delay=0.05, max_delay=10)
DISPATCHERS = [Adg(), reordering.Btpg(lookahead=1, gain=-np.inf), reordering.Gses(lookahead=1, gain=0.001, period=0)]


@pytest.mark.parametrize("make", [random_plan, random_plan_with_resources])
@given(
    st.integers(0, 2**32),
    st.lists(lasting | passing, min_size=1, max_size=3),
    st.integers(0, 99),
    st.sampled_from(DISPATCHERS),
)
@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@example(0, [Fault(kind="out_of_order", at=0.0, lasts=10)], 0, Adg())  # nothing can be out of order there
def test_every_robot_ends_in_a_definite_state_before_the_limit(run_context, make, random, events, seed, dispatcher):
    problem, plan = make(np.random.default_rng(random))
    try:
        result, missing, drawn = finished(run_context, problem, plan, Faults(events=tuple(events)), seed, dispatcher)
    except DispatchError:
        return
    reasons = result.unarrived
    assert result.simulated_s < 3000
    assert reasons.keys() == set(np.flatnonzero(missing).tolist())
    assert result.succeeded == (not reasons)
    assert result.succeeded or any(math.isinf(event.end) for event in drawn)
    assert not any("under way" in reason for reason in reasons.values()), reasons


AISLE = """type octile
height 5
width 11
map
...@@@@@...
...@@@@@...
...........
...@@@@@...
...@@@@@...
"""
SCENARIO = "version 1\n" + "".join(
    f"0\taisle.map\t11\t5\t{ax}\t{ay}\t{bx}\t{by}\t9\n"
    for ax, ay, bx, by in [(9, 2, 1, 2), (10, 0, 0, 1), (1, 3, 9, 3), (0, 4, 2, 4)]
)


def aisle(tmp_path, text=AISLE, agents=SCENARIO, **changes):
    """The record and the channels of four robots, one of which stops in the only aisle."""
    (tmp_path / "aisle.map").write_text(text)
    (tmp_path / "aisle.scen").write_text(agents.replace("\t5\t", f"\t{len(text.splitlines()) - 4}\t"))
    study = {
        "world": {"plugin": "movingai", "file": str(tmp_path / "aisle.map"), "resolution": 0.5},
        "scenario": {"plugin": "movingai", "file": str(tmp_path / "aisle.scen"), "robots": agents.count("aisle.map")},
        "roadmap": "grid",
        "planner": "prioritized",
        "faults": {"events": [{"kind": "stop", "robot": 0, "at": 9}], "patience": 10},
        "limits": {"execution": 400},
        "control_rate": 4,
        "recording": {"rate": 1},
    }
    study |= {key: value for key, value in changes.items() if key != "reaction"}
    study["faults"] |= {"reaction": changes.get("reaction", "wait")}
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / "recording.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None), Recording(paths.recording)


@pytest.mark.parametrize(
    ("changes", "others"),
    [
        ({"execution": "schedule_only"}, "waits for robot_"),
        ({"execution": "schedule_only", "dispatcher": "gses"}, "waits for robot_"),
        ({"execution": "schedule_only", "dispatcher": "btpg"}, "waits for robot_"),
        ({}, "waits for robot_"),
        ({"reaction": "replan"}, "has no way left to its goal: robot_0 stops"),
    ],
)
def test_a_robot_that_dies_in_the_only_aisle_leaves_all_others_in_a_definite_explained_state(tmp_path, changes, others):
    record, recording = aisle(tmp_path, **changes)
    assert record.status == "execution_aborted"
    assert record.unarrived["robot_0"] == "stopped for good at 9.0 s"
    assert record.unarrived.keys() == {"robot_0", "robot_1", "robot_2"}
    assert all(others in record.unarrived[name] for name in ("robot_1", "robot_2"))
    assert recording.channel("time")[-1] < 350
    kinds = recording.channel("event_kind").tolist()
    assert kinds.count("fault") == 1
    assert kinds.count("not_arrived") == 3


HALLS = AISLE.replace("11", "17").replace("...@@@@@...", ".....@@@@@@@.....").replace("." * 11, "." * 17)
CROSSING = "version 1\n" + "".join(
    f"0\taisle.map\t17\t5\t{ax}\t{ay}\t{bx}\t{by}\t9\n"
    for ax, ay, bx, by in [
        *[(0, 0, 16, 0), (0, 4, 16, 4), (1, 1, 15, 1)],
        *[(16, 1, 0, 1), (16, 3, 0, 3), (14, 2, 2, 0), (0, 2, 4, 0)],
    ]
)


def test_reasons_follow_the_order_that_the_dispatcher_has_changed(tmp_path):
    stop = {"events": [{"kind": "stop", "robot": 1, "at": 5}], "patience": 10}
    changes = {"dispatcher": {"plugin": "gses", "lookahead": 2}, "planner": "cbs", "execution": "schedule_only"}
    changes |= {"control_rate": 2, "roadmap": {"plugin": "grid", "cell_size": 0.5}, "faults": stop}
    record, _ = aisle(tmp_path, HALLS, CROSSING, **changes)
    first = {"robot_1": "stopped for good at 5.0 s"}
    waiting = dict.fromkeys(("robot_3", "robot_4", "robot_5"), "waits for robot_1, which stopped for good at 5.0 s")
    assert record.unarrived == first | waiting


ROWS = AISLE.splitlines()
LONGER = "\n".join([ROWS[0], "height 12", *ROWS[2:], *["...@@@@@..."] * 6, "...........", ""])
"""With another way around."""


def test_robots_go_another_way_around_one_that_stopped(tmp_path):
    record, recording = aisle(tmp_path, LONGER, reaction="replan")
    assert record.unarrived == {"robot_0": "stopped for good at 9.0 s"}
    assert "replan" in recording.channel("event_kind")


def test_robots_go_another_way_around_a_blocked_place(tmp_path):
    blocked = {"kind": "blocked", "at": 2, "place": [2.75, 4.75], "radius": 0.2}
    near = {"plugin": "adg", "lookahead": 1}  # what was released beyond the place is not taken back
    record, recording = aisle(tmp_path, LONGER, faults={"events": [blocked]}, dispatcher=near, reaction="replan")
    assert record.status == "succeeded", record.unarrived
    assert "replan" in recording.channel("event_kind")
    gap = np.hypot(*np.moveaxis(recording.channel("truth")[:, :, :2] - blocked["place"], 2, 0))
    assert gap.min() > 0.2


def test_robots_stand_before_a_blocked_place_until_it_is_free(tmp_path):
    blocked = {"kind": "blocked", "at": 2, "lasts": 60, "place": [2.75, 1.25]}
    record, recording = aisle(tmp_path, faults={"events": [blocked]}, execution="schedule_only")
    assert record.status == "succeeded", record.error
    time, x = recording.channel("time"), recording.channel("truth")[:, 0, 0]
    assert (x[time < 60] > 2.95).all()
    assert x[-1] < 1


def test_a_robot_that_gives_up_while_it_is_stopped_says_both(tmp_path):
    stop = {"events": [{"kind": "stop", "robot": 0, "at": 2, "lasts": 300}]}
    record, _ = aisle(tmp_path, faults=stop, navigator={"max_recoveries": 0}, limits={"execution": 20})
    assert record.unarrived["robot_0"] == "stopped at 2.0 s and gave up at (4.8, 1.2): no_progress"


def test_a_robot_that_stops_at_its_goal_has_arrived(tmp_path):
    stop = {"events": [{"kind": "stop", "robot": 3, "at": 20, "lasts": 300}]}
    record, recording = aisle(tmp_path, faults=stop, reaction="replan")
    assert record.status == "succeeded", record.unarrived
    assert "replan" in recording.channel("event_kind")
    assert recording.channel("time")[-1] < 100
