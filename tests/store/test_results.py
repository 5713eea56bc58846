"""Records on disk: attempts, cut lines, merging."""

import json
import sys

import pytest

from mrpbench_core import load
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.jsonl import Writer
from mrpbench_core.store.folder import ResultsFolder


@pytest.fixture
def folder(tmp_path):
    made = ResultsFolder(tmp_path / "results")
    made.create()
    return made


def record(run_id, attempt=1, status="succeeded", **more):
    return {"run_id": run_id, "attempt": attempt, "status": status, "metrics": {}, "config": {}} | more


def store(folder, shard, *records):
    with Writer(folder.shard(shard), exclusive=True) as writer:
        for entry in records:
            writer.write(entry)


def test_the_highest_attempt_wins_whichever_file_it_is_in(folder):
    store(folder, "2", record("aa", 1, "crashed"), record("bb", 3, "skipped"))
    store(folder, "1", record("aa", 2), record("bb", 2))
    results = load(folder.path)
    assert {entry["run_id"]: (entry["attempt"], entry["status"]) for entry in results} == {
        "aa": (2, "succeeded"),
        "bb": (3, "skipped"),
    }
    assert len(results) == 2
    assert results.statuses() == {"succeeded": 1, "skipped": 1}


def test_a_line_cut_off_by_a_crash_is_as_if_it_were_not_there(folder):
    store(folder, "1", record("aa"), record("bb"))
    file = folder.shard("1")
    whole = file.read_bytes()
    for length in range(len(whole)):
        file.write_bytes(whole[:length])
        assert [entry["run_id"] for entry in load(folder.path)] == ["aa", "bb"][: whole[:length].count(b"\n")]


def test_a_damaged_line_is_named_and_costs_only_its_own_run(folder, caplog):
    lines = [json.dumps(record("aa")), "{]", json.dumps(record("bb")), '"text"', ""]
    folder.shard("1").write_text("\n".join(lines))
    results = load(folder.path)
    assert [entry["run_id"] for entry in results] == ["aa", "bb"]
    assert results["bb"]["run_id"] == "bb"
    said = [message.getMessage() for message in caplog.records]
    assert said == [str(error) for error in results.damaged]
    assert f"{folder.shard('1')}:2: is not a record: " in said[0]
    assert f"{folder.shard('1')}:4: is not a record: " in said[1]
    assert "`mrpbench run` repeats it" in said[0]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ('"run_id":"../../aa"', "run_id"),
        ('"run_id":"bb\\n"', "run_id"),
        ('"status":"fine"', "status"),
        ('"attempt":"1"', "attempt"),
        ('"attempt":4294967296', "attempt"),
        ('"seed":9223372036854775808', "9223372036854775807"),
        ('"seed":1e400', "out of range"),
        ('"metrics":{"a.b":1' + 400 * "0" + "}", "9223372036854775807"),
        ('"metrics":[1]', "metrics"),
        ('"config":{"limits":{"planning":"60 s"}}', "planning"),
        ('"config":{"a":NaN}', "malformed"),
        ('"config":{"a":' + 2000 * "[" + 2000 * "]" + "}", "got `array`"),
        ('"new":"\\ud800"', "truncated"),
        ('"new":"\xff"', "decode"),
        ('"error":"no"', "error"),
    ],
)
def test_a_value_of_a_wrong_type_or_range_makes_a_line_no_record(folder, change, reason):
    bad = json.dumps(record("bb"))[:-1].encode() + b"," + change.encode("latin-1") + b"}\n"
    folder.shard("1").write_bytes(json.dumps(record("aa")).encode() + b"\n" + bad)
    results = load(folder.path)
    assert [entry["run_id"] for entry in results] == ["aa"]
    (error,) = results.damaged
    assert (error.file, error.line) == (folder.shard("1"), 2)
    assert reason in error.message


def test_wherever_one_bit_is_wrong_the_other_records_remain(folder):
    lines = [json.dumps(record(name, seed=3, metrics={"a.b": 1.5})).encode() + b"\n" for name in ("aa", "bb", "cc")]
    for place in range(8 * len(lines[1])):
        middle = bytearray(lines[1])
        middle[place // 8] ^= 1 << place % 8
        folder.shard("1").write_bytes(lines[0] + middle + lines[2])
        results = load(folder.path)
        rest = [entry["run_id"] for entry in results]
        assert "aa" in rest
        assert "cc" in rest or place // 8 == len(lines[1]) - 1  # without its end, the line continues with the next one
        assert len(rest) + len(results.damaged) >= (3 if "cc" in rest else 2)


def test_a_line_longer_than_the_limit_is_passed_over(folder, monkeypatch):
    monkeypatch.setattr("mrpbench_core.store.shards.LINE_LIMIT", 200)
    long = json.dumps(record("bb", timing={"note": 500 * "x"}))
    lines = [json.dumps(record("aa")), long, json.dumps(record("cc")), long]
    folder.shard("1").write_text("\n".join(lines))
    results = load(folder.path)
    assert [entry["run_id"] for entry in results] == ["aa", "cc"]
    assert [error.line for error in results.damaged] == [2]
    assert results["cc"]["run_id"] == "cc"


def test_a_folder_in_the_place_of_a_file_of_records_is_named(folder):
    store(folder, "1", record("aa"))
    folder.shard("2").mkdir()
    results = load(folder.path)
    assert [entry["run_id"] for entry in results] == ["aa"]
    assert "cannot be read" in results.damaged[0].message


def test_copying_files_merges_folders_and_the_same_run_counts_once(folder, tmp_path):
    other = ResultsFolder(tmp_path / "other")
    other.create()
    store(folder, "1", record("aa"), record("bb"))
    store(other, "2", record("bb"), record("cc"))
    folder.shard("2").write_bytes(other.shard("2").read_bytes())
    assert [entry["run_id"] for entry in load(folder.path)] == ["aa", "bb", "cc"]


def test_a_run_is_found_by_the_beginning_of_its_id(folder):
    store(folder, "1", record("abc1"), record("abd2"))
    results = load(folder.path)
    assert results["abd"]["run_id"] == "abd2"
    with pytest.raises(KeyError, match="2 runs begin with 'ab'"):
        results["ab"]
    with pytest.raises(KeyError, match="no runs begin with 'x'"):
        results["x"]


def test_rows_are_flat(folder):
    store(folder, "1", record("aa", metrics={"planning.solved": 1}, config={"planner": {"plugin": "cbs"}, "seed": 3}))
    (row,) = load(folder.path).to_rows()
    assert row["planning.solved"] == 1
    assert row["config.planner.plugin"] == "cbs"
    assert row["config.seed"] == 3


def test_a_table_of_pandas_has_the_last_attempt_of_each_run_in_flat_columns(folder):
    pytest.importorskip("pandas", reason="pandas is not installed")
    entries = [("aa", 1, 5.0), ("aa", 2, 3.0), ("bb", 1, None)]
    for run_id, attempt, cost in entries:
        more = {"metrics": {"planning.cost": cost}, "config": {"planner": {"plugin": "cbs"}}}
        store(folder, f"{run_id}{attempt}", record(run_id, attempt, **more, provenance={"a": {"b": 1}}))
    table = load(folder.path).to_pandas()
    assert table["run_id"].tolist() == ["aa", "bb"]
    assert table["attempt"].tolist() == [2, 1]
    assert table["planning.cost"].isna().tolist() == [False, True]
    assert table["config.planner.plugin"].tolist() == ["cbs", "cbs"]
    assert not [column for column in table.columns if column.startswith("provenance")]


def test_without_pandas_the_error_says_what_to_install(folder, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InputError, match="`to_pandas` needs pandas"):
        load(folder.path).to_pandas()


def test_results_show_as_a_table(folder, monkeypatch):
    monkeypatch.setenv("COLUMNS", "90")
    assert repr(load(folder.path)) == f"{folder.path}: 0 runs"
    for number in range(14):
        config = {"planner": {"plugin": "cbs" if number < 7 else "pbs\x1b[2J"}, "seed": number % 7}
        metrics = {"planning.cost": number / 3, "planning.solved": True, **{f"m.a{i}": None for i in range(20)}}
        store(folder, f"{number:02}", record(f"{number:016}", config=config, seed=number % 7, metrics=metrics))
    lines = repr(load(folder.path)).splitlines()
    assert lines[0] == f"{folder.path}: 14 runs (14 succeeded)"
    assert lines[1].split()[:5] == ["run", "planner.plugin", "seed", "status", "planning.cost"]
    assert lines[2].split()[:5] == ["0" * 12, "cbs", "0", "succeeded", "0"]
    assert lines[7] == "…"
    assert len(lines) == 13
    assert max(map(len, lines[1:])) <= 90
    assert "\x1b" not in repr(load(folder.path))


def test_a_folder_of_something_else_is_refused(tmp_path):
    with pytest.raises(InputError, match="is not a results folder"):
        load(tmp_path)
    (tmp_path / "thesis.tex").write_text("precious")
    with pytest.raises(InputError, match="is not empty"):
        ResultsFolder(tmp_path).create()


def test_links_to_unfinished_files_are_removed_and_not_followed(folder, tmp_path):
    precious = tmp_path / "precious"
    precious.mkdir()
    for part in ("recordings", "exports", "invocations", "."):
        (folder.path / part / ".x.partial").symlink_to(precious)
    folder.sweep()
    assert precious.is_dir()
    assert not list(folder.path.rglob(".x.partial"))


def test_unfinished_files_are_swept_and_finished_ones_kept(folder):
    unfinished = folder.run("aa").recording.with_name(".aa.zip.partial")
    unfinished.write_bytes(b"half")
    bag = folder.run("bb").exports / ".bag.partial"
    bag.mkdir(parents=True)
    finished = folder.run("cc").recording
    finished.write_bytes(b"whole")
    folder.sweep()
    assert not unfinished.exists()
    assert not bag.exists()
    assert finished.read_bytes() == b"whole"
