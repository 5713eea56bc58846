"""JSON lines."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files import jsonl
from mrpbench_core.files.errors import InputError


def test_written_lines_are_read_back(tmp_path):
    path = tmp_path / "a.jsonl"
    with jsonl.Writer(path, exclusive=True) as writer:
        writer.write({"a": 1, "b": [None, "ü\n\u2028"]})
        writer.write({})
    assert jsonl.read(path) == [{"a": 1, "b": [None, "ü\n\u2028"]}, {}]
    assert path.read_bytes().count(b"\n") == 2
    with pytest.raises(FileExistsError):
        jsonl.Writer(path, exclusive=True)


def test_a_line_cut_off_by_a_crash_is_skipped_and_then_replaced(tmp_path):
    path = tmp_path / "a.jsonl"
    path.write_bytes(b'{"a":1}\n{"a":2}')
    assert jsonl.read(path) == [{"a": 1}]
    writer = jsonl.Writer(path)
    writer.write({"a": 3})
    writer.close()
    writer.close()
    assert jsonl.read(path) == [{"a": 1}, {"a": 3}]


@pytest.mark.parametrize(
    ("content", "where"),
    [
        (b'{"a":1}\n{"a":\n{"a":3}\n', "a.jsonl:2:6: is not JSON"),
        (b"[1]\n", "a.jsonl:1: is not a JSON object"),
        (b'{"a":NaN}\n', "a.jsonl:1: is not JSON: NaN"),
        (b'{"a":"\xfc"}\n', "a.jsonl:1: is not UTF-8"),
        (b"\n\n" + 100_000 * b"[" + b"\n", "a.jsonl:3: is not JSON"),
        (b"\x00\x00\n", "a.jsonl:1:1: is not JSON"),
        (b'{"a":' + 5000 * b"9" + b"}\n", "a.jsonl:1: is not JSON"),
    ],
)
def test_a_corrupt_line_is_named(tmp_path, monkeypatch, content, where):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "a.jsonl"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        jsonl.read("a.jsonl")
    assert str(caught.value).startswith(where)


def test_numbers_that_json_cannot_say_are_not_written(tmp_path):
    with jsonl.Writer(tmp_path / "a.jsonl") as writer, pytest.raises(ValueError, match="JSON compliant"):
        writer.write({"a": float("nan")})
    assert jsonl.read(tmp_path / "a.jsonl") == []


@settings(deadline=None, max_examples=40)
@given(st.lists(st.dictionaries(st.text(), st.integers() | st.text(), max_size=3), max_size=4), st.integers(0, 200))
def test_wherever_a_file_is_cut_the_finished_lines_remain(tmp_path_factory, records, cut):
    path = tmp_path_factory.mktemp("cut") / "a.jsonl"
    with jsonl.Writer(path) as writer:
        for record in records:
            writer.write(record)
    content = path.read_bytes()[:cut]
    path.write_bytes(content)
    assert jsonl.read(path) == records[: content.count(b"\n")]
