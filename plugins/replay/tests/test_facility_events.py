import attrs
import numpy as np
from mrpbench_replay.facility_events import read_facility_events

from mrpbench_core.testing.fixtures.building import building


def test_doors_open_and_close_and_lifts_leave_and_arrive(store, run_context):
    time = np.arange(11.0)
    door = np.interp(time, [1, 2, 6, 7], [0, 1, 1, 0])
    cabin = np.interp(time, [2, 5], [0, 3])
    facility = np.stack([door, np.ones(11), cabin], axis=1)
    context = attrs.evolve(run_context, world=building())
    events = read_facility_events(store({"time": time, "facility": facility}, context=context), building())
    assert events == [
        [1.0, "door_opens", -1, "door"],
        [6.0, "door_closes", -1, "door"],
        [2.0, "lift_leaves", -1, "lift, L1"],
        [5.0, "lift_arrives", -1, "lift, L2"],
    ]


def test_a_recording_without_facilities_has_no_facility_events(store, chunk, run_context):
    assert read_facility_events(store(chunk), run_context.world) == []
