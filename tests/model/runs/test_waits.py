"""Why robots wait, found out from plan and progress."""

import attrs
import numpy as np
import pytest

from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.dependencies import Dependencies
from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Resource, Roadmap
from mrpbench_core.model.runs.plans import read_plans
from mrpbench_core.model.runs.waits import Reason, explain_waits

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


def explained(context, rows):
    channels = {name: (lambda values=values: values) for name, values in rows.items()}
    waits = explain_waits(context, channels, read_plans(context, channels))
    assert waits is not None
    return [
        [(Reason(reason), culprit) for reason, culprit in zip(*row, strict=True)]
        for row in zip(waits.reason.T.tolist(), waits.culprit.T.tolist(), strict=True)
    ]


def test_the_robot_that_passes_first_is_named_until_it_has_passed(run_context, rows):
    first, second = explained(run_context, rows)
    assert first == [(Reason.ROBOT, 1)] * 4 + [(Reason.NONE, -1)] * 2
    assert second == [(Reason.NONE, -1)] * SAMPLES


def test_a_resource_that_was_requested_is_the_reason(rows, run_context):
    waits_for = np.full((SAMPLES, 2), -1, "i4")
    waits_for[:2, 0] = 1
    doors = tuple(Resource(name=name, kind="door") for name in ("front", "back"))
    problem = attrs.evolve(run_context.problem, roadmap=attrs.evolve(run_context.problem.roadmap, resources=doors))
    context = attrs.evolve(run_context, problem=problem)
    assert explained(context, rows | {"waits_for": waits_for})[0][:3] == [(Reason.RESOURCE, 1)] * 2 + [
        (Reason.ROBOT, 1)
    ]


def test_a_recovery_is_the_reason(run_context, rows):
    mode = rows["mode"].copy()
    mode[:2, 0] = RECOVERING
    assert explained(run_context, rows | {"mode": mode})[0][:3] == [(Reason.RECOVERY, -1)] * 2 + [(Reason.ROBOT, 1)]


def test_a_robot_with_released_segments_that_waits_starts_late(run_context, rows):
    released = np.maximum(rows["released"], 1)
    assert explained(run_context, rows | {"released": released})[0][:4] == [(Reason.START, -1)] * 4


def test_a_robot_that_stands_on_released_segments_is_blocked_by_the_robot_before_it(run_context, rows):
    truth = rows["truth"].copy()
    truth[:, 0] = (0.9, 0, 0)
    reasons = explained(run_context, rows | {"truth": truth})[0]
    assert reasons[4:] == [(Reason.BLOCKED, 1)] * 2
    truth[:, 0, 0] = -3
    assert explained(run_context, rows | {"truth": truth})[0][4:] == [(Reason.BLOCKED, -1)] * 2


def test_a_robot_that_turns_on_the_spot_is_not_blocked(run_context, rows):
    truth = rows["truth"].copy()
    truth[:, 0] = 0
    truth[:, 0, 2] = np.arange(SAMPLES) / 5
    assert explained(run_context, rows | {"truth": truth})[0][4:] == [(Reason.NONE, -1)] * 2


def test_a_dispatcher_that_releases_by_the_clock_waits_for_its_time(rows, run_context):
    late = Plan(paths=(RobotPath(edge=[-1, 0], enter=[4, 4], leave=[4, 5]), RobotPath(edge=[2], enter=[0], leave=[1])))
    roadmap = attrs.evolve(run_context.problem.roadmap, tick=0.1)
    context = attrs.evolve(
        run_context,
        problem=attrs.evolve(run_context.problem, roadmap=roadmap),
        result=attrs.evolve(run_context.result, plan=late),
    )
    assert explained(context, rows)[0][:4] == [(Reason.SCHEDULE, -1)] * 4


def test_a_pending_plan_is_the_reason_where_nothing_else_is(run_context, rows):
    cleared = np.ones((SAMPLES, 2), "i4")
    events = {
        "event_time": np.array([0.3]),
        "event_kind": np.array(["replan"]),
        "event_robot": np.array([-1], "i4"),
        "event_detail": np.array([""]),
    }
    reasons = explained(attrs.evolve(run_context, latency=0.2), rows | {"cleared": cleared} | events)[0]
    assert [reason for reason, _ in reasons[1:4]] == [Reason.REPLAN] * 3


def test_without_the_times_of_a_new_plan_the_holder_of_the_next_waypoint_is_named(run_context, rows, new_plan):
    routes = {name: values for name, values in new_plan(0).items() if name not in ("route_edge", "route_leave")}
    reasons = explained(run_context, rows | routes)[0]
    assert reasons[:4] == [(Reason.ROBOT, 1)] * 3 + [(Reason.UNKNOWN, -1)]


def test_a_dependency_of_a_new_plan_is_the_reason(run_context, rows, new_plan):
    reasons = explained(run_context, rows | new_plan(0))[0]
    assert reasons[:4] == [(Reason.ROBOT, 1)] * 4


def test_without_progress_nothing_is_said(run_context, rows):
    channels = {name: (lambda name=name: rows[name]) for name in ("time", "truth")}
    assert explain_waits(run_context, channels, read_plans(run_context, channels)) is None


def test_a_delay_is_the_reason_only_where_the_way_is_released(run_context, rows):
    """Robot 0 is stopped from 0.2 s to 0.5 s, and its way is released at 0.4 s."""
    events = {
        "event_time": np.array([0.2]),
        "event_kind": np.array(["delay"]),
        "event_robot": np.array([0], "i4"),
        "event_detail": np.array(["0.3 s"]),
    }
    assert explained(run_context, rows | events)[0] == [(Reason.ROBOT, 1)] * 4 + [(Reason.DELAY, -1), (Reason.NONE, -1)]


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
    return problem, Plan(paths=tuple(RobotPath(edge=[robot], enter=[0], leave=[1]) for robot in range(4)))


def test_where_orders_were_switched_the_robot_that_passed_first_is_named(run_context):
    """Two robots cross one vertex; robot 1 passes first, although the plan has it second."""
    roadmap = Roadmap(
        position=[[0, 0], [0, 2], [1, 1], [2, 0], [2, 2]],
        level=[0] * 5,
        heading=[np.nan] * 5,
        edges=[[0, 2], [1, 2], [2, 3], [2, 4]],
        duration=[[1] * 4],
        tick=1.0,
    )
    problem = Problem(
        roadmap=roadmap, profile=[0, 0], radius=[0.2] * 2, start=[0, 1], ready=[0, 0], goals=(((3,),), ((4,),))
    )
    first = RobotPath(edge=[0, 2], enter=[0, 1], leave=[1, 2])
    second = RobotPath(edge=[-1, 1, 3], enter=[0, 2, 3], leave=[2, 3, 4])
    routes = tuple(
        Route(waypoint=[(*roadmap.position[v], np.nan) for v in own], level=[0] * len(own), speed=[1] * (len(own) - 1))
        for own in ([0, 2, 3], [1, 1, 2, 4])
    )
    result = attrs.evolve(run_context.result, plan=Plan(paths=(first, second)))
    context = attrs.evolve(run_context, problem=problem, result=result, routes=routes)
    rows = {
        "time": np.arange(6.0),
        "truth": np.random.default_rng(0).normal(size=(6, 2, 3)),
        "released": np.array([[0, 1], [0, 2], [0, 3], [0, 3], [2, 3], [2, 3]], "i4"),
        "reached": np.array([[0, 0], [0, 1], [0, 2], [0, 3], [1, 3], [2, 3]], "i4"),
        "cleared": np.array([[0, 0], [0, 1], [0, 2], [0, 3], [1, 3], [2, 3]], "i4"),
        "mode": np.array([[WAITING, FOLLOWING]] * 4 + [[FOLLOWING, WAITING]] * 2, "u1"),
    }
    assert explained(context, rows)[0][:4] == [(Reason.ROBOT, 1)] * 3 + [(Reason.UNKNOWN, -1)]
