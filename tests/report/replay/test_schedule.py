from mrpbench_core.report.replay.packing import Packing
from mrpbench_core.report.replay.schedule import pack_schedule


def test_segments_of_one_kind_become_one(run_context, unpack):
    packing = Packing()
    pack_schedule(run_context, packing)
    found = unpack(packing.layout, packing.text())
    tick = run_context.problem.roadmap.tick
    assert found["plan_first"].tolist() == [0, 2, 3]
    assert found["plan_end"].tolist() == [tick, 2 * tick, tick]
    assert found["plan_waits"].tolist() == [1, 0, 0]
