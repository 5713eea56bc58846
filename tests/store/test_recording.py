"""Recordings come back as they were written."""

import attrs
import numpy as np
import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.recording import Recording, RecordingWriter


def test_context_and_channels_come_back_equal(tmp_path, run_context):
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    writer.write({"time": np.arange(3.0), "event_kind": np.array(["spin"])})
    writer.write({"time": np.arange(3.0, 5.0), "event_kind": np.array(["back_up"])})
    writer.close()
    recording = Recording(tmp_path / "a.zip")
    context = recording.context()
    for field in attrs.fields(type(run_context)):
        if field.name != "goal":  # holds NaN, which equals nothing
            assert getattr(context, field.name) == getattr(run_context, field.name), field.name
    np.testing.assert_array_equal(context.goal, run_context.goal)
    assert recording.channel("time").tolist() == [0, 1, 2, 3, 4]
    assert recording.channel("event_kind").tolist() == ["spin", "back_up"]
    assert [len(chunk["time"]) for chunk in recording.chunks()] == [3, 2]
    recording.close()


def test_nothing_stands_under_the_final_name_before_close(tmp_path, run_context):
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    writer.write({"time": np.arange(3.0)})
    assert not (tmp_path / "a.zip").exists()
    writer.discard()
    assert list(tmp_path.iterdir()) == []


def test_a_missing_or_foreign_file_is_named(tmp_path):
    with pytest.raises(InputError, match="no recording here"):
        Recording(tmp_path / "none.zip")
    (tmp_path / "foreign.zip").write_text("hello")
    with pytest.raises(InputError, match="not a recording"):
        Recording(tmp_path / "foreign.zip")


def test_the_routes_of_the_first_plan_and_of_the_last_are_both_there(tmp_path, run_context):
    count = len(run_context.routes)
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    writer.write(
        {
            "route_time": np.full(count, 2.0),
            "route_revision": np.ones(count, "i4"),
            "route_robot": np.arange(count, dtype="i4"),
            "route_waypoint": np.full((count, 3), 9.0),
            "route_level": np.zeros(count, "i2"),
            "route_speed": np.full(count, np.inf),
        }
    )
    writer.close()
    recording = Recording(tmp_path / "a.zip")
    assert recording.first_context().routes == run_context.routes
    assert [route.waypoint.tolist() for route in recording.context().routes] == [[[9, 9, 9]]] * count
    recording.close()


def test_scans_of_unlike_lidars_are_one_channel(tmp_path, run_context):
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    writer.write({"scan_ranges": np.ones((2, 3), "f4")})
    writer.write({"scan_ranges": np.ones((1, 5), "f4")})
    writer.close()
    recording = Recording(tmp_path / "a.zip")
    ranges = recording.channel("scan_ranges")
    assert np.isnan(ranges).tolist() == [[False] * 3 + [True] * 2] * 2 + [[False] * 5]
    recording.close()
