import attrs
import numpy as np
from mrpbench_replay.packing import Packing
from mrpbench_replay.schedule import pack_schedule

from mrpbench_core.model.planning.plan import Plan, RobotPath
from mrpbench_core.model.runs.plans import RecordedPlan, read_plans


def packed(unpack, plans, tick):
    packing = Packing()
    pack_schedule(plans, tick, packing)
    return unpack(packing.layout, packing.text())


def test_segments_of_one_kind_become_one(run_context, unpack):
    tick = run_context.problem.roadmap.tick
    first = RecordedPlan(time=0.0, routes=run_context.routes, plan=run_context.result.plan)
    found = packed(unpack, [first], tick)
    assert found["plan_first"].tolist() == [0, 2, 3]
    assert found["plan_end"].tolist() == [tick, 2 * tick, tick]
    assert found["plan_waits"].tolist() == [1, 0, 0]


def test_every_plan_has_its_times(store, chunk, unpack, new_plan):
    new = new_plan(1)
    new["route_leave"] = np.array([0, 2, 4, 0, 1])
    recording = store(chunk | new)
    found = packed(unpack, read_plans(recording.first_context(), recording.channels), 1.0)
    assert found["plan_first"].tolist() == [0, 2, 3, 5, 6]
    assert found["plan_end"].tolist() == [1, 2, 1, 2, 4, 1]


def test_a_plan_known_by_its_routes_alone_has_no_times(run_context, unpack):
    first = RecordedPlan(time=0.0, routes=run_context.routes, plan=run_context.result.plan)
    found = packed(unpack, [first, attrs.evolve(first, time=1.0, plan=None)], 1.0)
    assert found["plan_first"].tolist() == [0, 2, 3, 3, 3]
    assert packed(unpack, [attrs.evolve(first, plan=None)], 1.0) == {}


def test_waits_after_the_last_move_are_left_out(run_context, unpack):
    path = RobotPath(edge=[0, -1, -1], enter=[0, 1, 2], leave=[1, 2, 5])
    plan = RecordedPlan(time=0.0, routes=run_context.routes[:1], plan=Plan(paths=(path,)))
    assert packed(unpack, [plan], 1.0)["plan_end"].tolist() == [1]
