"""Why robots wait, found out from plan and progress."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.planning.dependencies import Dependencies
from mrpbench_core.model.planning.plan import Path, Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.report.replay.plans import read_plans
from mrpbench_core.report.replay.waits import Reason, explain_waits

SAMPLES = 6
WAITING, FOLLOWING, RECOVERING = 1, 0, 2


@pytest.fixture
def rows():
    """Robot 0 stands behind robot 1 until that has cleared its start, at sample 3."""
    one, none = np.ones(SAMPLES, "i4"), np.zeros(SAMPLES, "i4")
    passed = (np.arange(SAMPLES) >= 3).astype("i4")
    truth = np.zeros((SAMPLES, 2, 3))
    truth[..., 0] = (0, 1) + np.arange(SAMPLES)[:, None] / 10
    return {
        "time": np.arange(SAMPLES) / 10,
        "truth": truth,
        "released": np.stack([2 * (np.arange(SAMPLES) >= 4).astype("i4"), one], axis=1),
        "reached": np.stack([none, none], axis=1),
        "cleared": np.stack([none, passed], axis=1),
        "mode": np.stack([np.where(np.arange(SAMPLES) >= 4, FOLLOWING, WAITING), none], axis=1).astype("u1"),
    }


def explained(recording, config=None):
    waits = explain_waits(recording, read_plans(recording), config or {})
    assert waits is not None
    return [
        [(Reason(reason), culprit) for reason, culprit in zip(*row, strict=True)]
        for row in zip(waits.reason.T.tolist(), waits.culprit.T.tolist(), strict=True)
    ]


def test_the_robot_that_passes_first_is_named_until_it_has_passed(store, rows):
    first, second = explained(store(rows))
    assert first == [(Reason.ROBOT, 1)] * 4 + [(Reason.NONE, -1)] * 2
    assert second == [(Reason.NONE, -1)] * SAMPLES


def test_a_resource_that_was_requested_is_the_reason(store, rows, run_context):
    waits_for = np.full((SAMPLES, 2), -1, "i4")
    waits_for[:2, 0] = 1
    doors = tuple(Resource(name=name, kind="door") for name in ("front", "back"))
    problem = attrs.evolve(run_context.problem, roadmap=attrs.evolve(run_context.problem.roadmap, resources=doors))
    recording = store(rows | {"waits_for": waits_for}, context=attrs.evolve(run_context, problem=problem))
    assert explained(recording)[0][:3] == [(Reason.RESOURCE, 1)] * 2 + [(Reason.ROBOT, 1)]


def test_a_recovery_is_the_reason(store, rows):
    mode = rows["mode"].copy()
    mode[:2, 0] = RECOVERING
    assert explained(store(rows | {"mode": mode}))[0][:3] == [(Reason.RECOVERY, -1)] * 2 + [(Reason.ROBOT, 1)]


def test_a_robot_with_released_segments_that_waits_starts_late(store, rows):
    released = np.maximum(rows["released"], 1)
    assert explained(store(rows | {"released": released}))[0][:4] == [(Reason.START, -1)] * 4


def test_a_robot_that_stands_on_released_segments_is_blocked_by_the_robot_before_it(store, rows):
    truth = rows["truth"].copy()
    truth[:, 0] = (0.9, 0, 0)
    reasons = explained(store(rows | {"truth": truth}))[0]
    assert reasons[4:] == [(Reason.BLOCKED, 1)] * 2
    truth[:, 0, 0] = -3
    assert explained(store(rows | {"truth": truth}))[0][4:] == [(Reason.BLOCKED, -1)] * 2


def test_a_robot_that_turns_on_the_spot_is_not_blocked(store, rows):
    truth = rows["truth"].copy()
    truth[:, 0] = 0
    truth[:, 0, 2] = np.arange(SAMPLES) / 5
    assert explained(store(rows | {"truth": truth}))[0][4:] == [(Reason.NONE, -1)] * 2


def test_a_dispatcher_that_releases_by_the_clock_waits_for_its_time(store, rows, run_context):
    late = Plan(paths=(Path(edge=[-1, 0], enter=[4, 4], leave=[4, 5]), Path(edge=[2], enter=[0], leave=[1])))
    roadmap = attrs.evolve(run_context.problem.roadmap, tick=0.1)
    context = attrs.evolve(
        run_context,
        problem=attrs.evolve(run_context.problem, roadmap=roadmap),
        result=attrs.evolve(run_context.result, plan=late),
    )
    assert explained(store(rows, context=context))[0][:4] == [(Reason.SCHEDULE, -1)] * 4


def test_a_pending_plan_is_the_reason_where_nothing_else_is(store, rows):
    cleared = np.ones((SAMPLES, 2), "i4")
    events = {
        "event_time": np.array([0.3]),
        "event_kind": np.array(["replan"]),
        "event_robot": np.array([-1], "i4"),
        "event_detail": np.array([""]),
    }
    reasons = explained(store(rows | {"cleared": cleared} | events), {"replanning": {"latency": 0.2}})[0]
    assert [reason for reason, _ in reasons[1:4]] == [Reason.REPLAN] * 3


def test_without_the_times_of_a_new_plan_the_holder_of_the_next_waypoint_is_named(store, rows, new_plan):
    routes = {name: values for name, values in new_plan(0).items() if name not in ("route_edge", "route_leave")}
    reasons = explained(store(rows | routes))[0]
    assert reasons[:4] == [(Reason.ROBOT, 1)] * 3 + [(Reason.UNKNOWN, -1)]


def test_a_dependency_of_a_new_plan_is_the_reason(store, rows, new_plan):
    reasons = explained(store(rows | new_plan(0)))[0]
    assert reasons[:4] == [(Reason.ROBOT, 1)] * 4


def test_without_progress_nothing_is_said(store, chunk):
    recording = store({name: chunk[name] for name in ("time", "truth")})
    assert explain_waits(recording, read_plans(recording), {}) is None


def test_robots_that_move_in_a_cycle_form_a_rotation(square):
    graph = Dependencies(*square)
    move = graph.next_move(0, 0)
    assert graph.rotates(move)
    assert sorted(dependency.robot for dependency in graph.of(move)) == [1, 2, 3]
    assert graph.next_move(0, 1) is None


@pytest.fixture
def square():
    """Four robots on four vertices, each moving to the next one."""
    nan = float("nan")
    roadmap = Roadmap(
        position=[[0, 0], [1, 0], [1, 1], [0, 1]],
        level=[0] * 4,
        heading=[nan] * 4,
        edges=[[0, 1], [1, 2], [2, 3], [3, 0]],
        duration=[[1] * 4],
        tick=1.0,
    )
    problem = Problem(
        roadmap=roadmap,
        profile=[0] * 4,
        radius=[0.2] * 4,
        start=[0, 1, 2, 3],
        ready=[0] * 4,
        goals=(((1,),), ((2,),), ((3,),), ((0,),)),
    )
    return problem, Plan(paths=tuple(Path(edge=[robot], enter=[0], leave=[1]) for robot in range(4)))
