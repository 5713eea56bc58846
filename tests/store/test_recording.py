"""Recordings come back as they were written."""

import io
import json
import random
import zipfile

import attrs
import numpy as np
import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.recording import Recording, RecordingWriter


def test_context_and_channels_come_back_equal(tmp_path, run_context):
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    for begin, end, kind in ((0, 3, "spin"), (3, 5, "back_up")):
        event = {"event_time": np.array([begin]) / 2, "event_robot": np.array([-1]), "event_detail": np.array([""])}
        writer.write({"time": np.arange(begin, end) * 1.0, "event_kind": np.array([kind]), **event})
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
            "time": np.zeros(1),
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
    for count, beams in ((2, 3), (1, 5)):
        rows = {"scan_time": np.full(count, beams * 1.0), "scan_robot": np.zeros(count, "i4")}
        writer.write({"time": np.full(1, beams * 1.0), "scan_ranges": np.ones((count, beams), "f4"), **rows})
    writer.close()
    recording = Recording(tmp_path / "a.zip")
    ranges = recording.channel("scan_ranges")
    assert np.isnan(ranges).tolist() == [[False] * 3 + [True] * 2] * 2 + [[False] * 5]
    recording.close()


@pytest.fixture
def stored(tmp_path, run_context):
    writer = RecordingWriter(tmp_path / "a.zip", run_context)
    writer.write({"time": np.arange(3.0), "truth": np.zeros((3, 2, 3)), "level": np.zeros((3, 2), "i2")})
    writer.close()
    return tmp_path / "a.zip"


def read(file):
    """Everything in a recording."""
    recording = Recording(file)
    try:
        context = recording.context()
        return (
            context.run_id,
            {name: load().tolist() for name, load in recording.channels.items()},
            list(recording.chunks()),
        )
    finally:
        recording.close()


def replace(file, name, content):
    """Give a file in the recording another content, with the right checksum."""
    with zipfile.ZipFile(file) as source:
        files = {entry: source.read(entry) for entry in source.namelist()}
    if isinstance(content, np.ndarray):
        buffer = io.BytesIO()
        np.save(buffer, content)
        content = buffer.getvalue()
    with zipfile.ZipFile(file, "w") as target:
        for entry, old in (files | {name: content}).items():
            target.writestr(entry, content if entry == name else old)


def test_wherever_bytes_are_wrong_it_reads_the_same_or_names_the_file(stored):
    content, expected = stored.read_bytes(), read(stored)[:2]
    rng = random.Random(1)
    for place in range(0, len(content), 23):
        damaged = bytearray(content)
        damaged[place] ^= 1 << rng.randrange(8)
        stored.write_bytes(damaged if place % 2 else damaged[: place + 1])
        try:
            assert read(stored)[:2] == expected
        except InputError as error:
            assert error.file == stored  # noqa: PT017 - either outcome is right
            assert "\n" not in str(error)  # noqa: PT017


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("time/000000.npy", np.array([0.0, np.nan, 2.0]), "time is not finite"),
        ("time/000000.npy", np.arange(4.0), "shape"),
        ("time/000000.npy", np.array(["a", "b", "c"]), "time has the type <U1"),
        ("truth/000000.npy", np.zeros((3, 3, 3)), "truth has shape"),
        ("truth/000000.npy", np.full((3, 2, 3), np.inf), "truth is not finite"),
        ("level/000000.npy", np.ones((3, 2), "i2"), "level does not exist"),
        ("level/000000.npy", b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'shape': (9" + 20 * b"9", "level"),
        ("mode/000000.npy", np.full((3, 2), 9, "u1"), "mode does not exist"),
        ("contact/000000.npy", np.zeros((1, 2), "i4"), "has no channel contact_time"),
        ("context.json", b'{"format": 1, "context": []}', "its context"),
        ("context.json", b'{"format": [], "context": {}}', r"format \[\]"),
        ("context.json", b"[" * 10**5, "not a recording"),
        ("context/0.npy", b"PK", "context/0.npy"),
    ],
)  # fmt: skip
def test_a_wrong_type_shape_or_number_is_named(stored, name, content, reason):
    replace(stored, name, content)
    with pytest.raises(InputError, match=reason) as caught:
        read(stored)
    assert caught.value.file == stored
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda context: context["fleet"]["robots"].pop(), "entries"),
        (lambda context: context["world"].update(levels=[]), "world has no level"),
        (lambda context: context["problem"]["roadmap"].update(tick=10**400), "tick"),
        (lambda context: context["problem"]["goals"][0][0].append(99), "problem.goals does not exist"),
        (lambda context: context.update(period="0.05"), r"expected float @ \$.period"),
        (lambda context: context["result"].update(status="fine"), "status"),
        (lambda context: context.pop("routes"), "routes"),
    ],
)
def test_a_context_that_contradicts_itself_is_named(stored, change, reason):
    with zipfile.ZipFile(stored) as source:
        header = json.loads(source.read("context.json"))
    change(header["context"])
    replace(stored, "context.json", json.dumps(header).encode())
    with pytest.raises(InputError, match=f"its context: .*{reason}"):
        read(stored)


def test_no_more_memory_is_taken_than_the_limit(stored, monkeypatch):
    monkeypatch.setattr("mrpbench_core.store.recording.UNBOUNDED", 100_000)
    assert read(stored)
    with zipfile.ZipFile(stored, "a", zipfile.ZIP_DEFLATED) as target:
        target.writestr("truth/000001.npy", bytes(5_000_000))
    with pytest.raises(InputError, match="a recording takes at most 200 times its size"):
        read(stored)


def test_a_method_of_compression_without_a_bound_is_refused(stored):
    with zipfile.ZipFile(stored, "a", zipfile.ZIP_LZMA) as target:
        target.writestr("truth/000001.npy", bytes(5_000_000))
    with pytest.raises(InputError, match="compressed by the method 14"):
        read(stored)
