import attrs
import numpy as np

from mrpbench_core.report.replay.packing import Packing
from mrpbench_core.report.replay.plans import RecordedPlan, read_plans
from mrpbench_core.report.replay.schedule import pack_schedule


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


def test_every_plan_has_its_times(store, chunk, unpack):
    new = {
        "route_time": np.full(5, 1.0),
        "route_revision": np.ones(5, "i4"),
        "route_robot": np.array([0, 0, 0, 1, 1], "i4"),
        "route_waypoint": np.array([[0.5, 0.5, 0], [0.5, 0.5, 0], [1.5, 0.5, 0], [1.5, 0.5, 0], [2.5, 0.5, 0]]),
        "route_level": np.zeros(5, "i2"),
        "route_speed": np.ones(5),
        "route_edge": np.array([-1, -1, 0, -1, 2], "i4"),
        "route_leave": np.array([0, 2, 4, 0, 1]),
    }
    found = packed(unpack, read_plans(store(chunk | new)), 1.0)
    assert found["plan_first"].tolist() == [0, 2, 3, 5, 6]
    assert found["plan_end"].tolist() == [1, 2, 1, 2, 4, 1]


def test_a_plan_known_by_its_routes_alone_has_no_times(run_context, unpack):
    first = RecordedPlan(time=0.0, routes=run_context.routes, plan=run_context.result.plan)
    found = packed(unpack, [first, attrs.evolve(first, time=1.0, plan=None)], 1.0)
    assert found["plan_first"].tolist() == [0, 2, 3, 3, 3]
    assert packed(unpack, [attrs.evolve(first, plan=None)], 1.0) == {}
