"""JSON lines."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.files import jsonl


def read(path):
    """The objects of the finished lines."""
    return [json.loads(line) for line in path.read_bytes().split(b"\n")[:-1]]


def test_written_lines_are_read_back(tmp_path):
    path = tmp_path / "a.jsonl"
    with jsonl.Writer(path, exclusive=True) as writer:
        writer.write({"a": 1, "b": [None, "ü\n\u2028"]})
        writer.write({})
    assert read(path) == [{"a": 1, "b": [None, "ü\n\u2028"]}, {}]
    assert path.read_bytes().count(b"\n") == 2
    with pytest.raises(FileExistsError):
        jsonl.Writer(path, exclusive=True)


def test_a_line_cut_off_by_a_crash_is_replaced(tmp_path):
    path = tmp_path / "a.jsonl"
    path.write_bytes(b'{"a":1}\n{"a":2}')
    writer = jsonl.Writer(path)
    writer.write({"a": 3})
    writer.close()
    writer.close()
    assert read(path) == [{"a": 1}, {"a": 3}]


def test_numbers_that_json_cannot_say_are_not_written(tmp_path):
    with jsonl.Writer(tmp_path / "a.jsonl") as writer, pytest.raises(ValueError, match="JSON compliant"):
        writer.write({"a": float("nan")})
    assert read(tmp_path / "a.jsonl") == []


@settings(deadline=None, max_examples=40)
@given(st.lists(st.dictionaries(st.text(), st.integers() | st.text(), max_size=3), max_size=4), st.integers(0, 200))
def test_wherever_a_file_is_cut_the_finished_lines_remain(tmp_path_factory, records, cut):
    path = tmp_path_factory.mktemp("cut") / "a.jsonl"
    with jsonl.Writer(path) as writer:
        for record in records:
            writer.write(record)
    content = path.read_bytes()[:cut]
    path.write_bytes(content)
    jsonl.Writer(path).close()
    assert read(path) == records[: content.count(b"\n")]
    assert path.read_bytes() == content[: content.rfind(b"\n") + 1]
