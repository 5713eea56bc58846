import numpy as np
from mrpbench_replay.events import read_contacts, read_events


def test_periods_in_contact_become_one_contact_until_they_part(store, chunk):
    contacts = read_contacts(store(chunk))
    assert contacts == [[1.0, 1.1, 0, 1], [3.0, 3.0, 0, -1]]


def test_the_same_pair_may_touch_twice(store):
    times = np.array([1.0, 1.05, 5.0, 5.05])
    assert len(read_contacts(store({"contact_time": times, "contact": np.array([[0, 1]] * 4)}))) == 2


def test_arrivals_are_events_too(store, chunk, run_context):
    events = read_events(store(chunk), run_context, [])
    assert events == [[1.5, "spin", 0, "</script><b>"], [2.0, "arrived", 1, ""], [4.0, "arrived", 0, ""]]


def test_recordings_without_events_and_contacts_have_none(store, chunk, run_context):
    recording = store({"time": chunk["time"], "truth": chunk["truth"]})
    assert read_events(recording, run_context, []) == []
    assert read_contacts(recording) == []


def test_contacts_are_not_listed_twice(store, chunk, run_context):
    events = {"event_kind": np.array(["contact"])}
    assert [kind for _, kind, *_ in read_events(store(chunk | events), run_context, [])] == ["arrived", "arrived"]
