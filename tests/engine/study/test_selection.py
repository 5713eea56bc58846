"""Shards and the choice of runs."""

import types

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.engine.study.selection import in_shard, read_shard_option, select
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results, origin


@settings(deadline=None)
@given(st.text("0123456789abcdef", min_size=16, max_size=16), st.integers(1, 50))
def test_every_run_is_in_one_shard(run_id, count):
    assert [in_shard(run_id, (index, count)) for index in range(count)].count(True) == 1


@pytest.mark.parametrize("text", ["", "1", "/", "1/", "/2", "2/2", "-1/2", "1/0", "a/b", "1/2/3"])
def test_a_word_that_is_not_a_shard_is_refused(text):
    with pytest.raises(InputError, match="not i/n"):
        read_shard_option(text)
    assert read_shard_option("0/1") == (0, 1)


@pytest.fixture
def results(tmp_path):
    """`good` and `bad` are recorded with code `old`; `new` is not recorded."""
    folder = ResultsFolder(tmp_path / "results")
    folder.create()
    with Writer(folder.shard("1")) as writer:
        for run_id, status in (("good", "succeeded"), ("bad", "crashed")):
            provenance = {"versions": "old"}
            writer.write({"run_id": run_id, "attempt": 4, "status": status, "config": {}, "provenance": provenance})
    return Results(folder)


@pytest.mark.parametrize(
    ("rerun", "code", "todo", "changed"),
    [
        (None, "old", {"new": 1}, ()),
        (None, "other", {"new": 1}, ("good", "bad")),
        ("failed", "old", {"new": 1, "bad": 5}, ()),
        ("failed", "other", {"new": 1, "bad": 5}, ("good",)),
        ("changed", "old", {"new": 1}, ()),
        ("changed", "other", {"new": 1, "good": 5, "bad": 5}, ()),
        ("all", "old", {"new": 1, "good": 5, "bad": 5}, ()),
    ],
)
def test_a_repeated_run_is_the_next_attempt(results, rerun, code, todo, changed):
    points = [types.SimpleNamespace(run_id=run_id) for run_id in ("new", "good", "bad")]
    selection = select(points, results, rerun, None, lambda point: origin({"versions": code}))
    assert {point.run_id: attempt for point, attempt in selection.todo} == todo
    assert selection.changed == changed
    assert selection.chosen == ("new", "good", "bad")
