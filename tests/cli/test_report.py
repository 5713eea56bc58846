"""`mrpbench report` and the files it writes."""

import base64
import csv
import json
import re
import shutil
import zlib
from pathlib import Path

import pytest

from mrpbench_core import run


def rows(file):
    with Path(file).open(newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.fixture(scope="module")
def four_runs(tmp_path_factory, tiny_map, tiny_study):
    """Return the results of four runs."""
    folder = tmp_path_factory.mktemp("four")
    (folder / "tiny.map").write_text(tiny_map)
    (folder / "tiny.yaml").write_text(tiny_study + "  planner.order: [given, farthest_first]\n")
    run(folder / "tiny.yaml", out=folder / "results")
    return folder / "results"


@pytest.fixture
def study(mrpbench, four_runs):
    """Return the command line in a folder with a copy of these results."""
    shutil.copytree(four_runs, "results/tiny")
    return mrpbench


def stored(folder="results/tiny"):
    lines = (line for file in Path(folder, "runs").iterdir() for line in file.read_text().splitlines())
    return [json.loads(line) for line in lines]


def test_tables_have_counts_and_intervals_and_the_answer_is_last(study):
    code, output, errors = study("report", "results/tiny")
    assert (code, errors) == (0, "")
    assert "2/2        100 % [34, 100]" in output
    for words in (
        "How the runs ended",
        "Means over all runs that have the value",
        "Seeds: 0..1; repeats: 0.",
        "Wilson intervals",
    ):
        assert words in output
    assert output.index("How the runs ended") < output.index("too few to compare") < output.index("wrote ")
    assert "2 times the planning limit" not in output, "the rules are in the page"


def test_the_files_have_the_numbers_of_the_tables(study):
    code, output, _ = study("report", "results/tiny", "--json", "--csv", "a.csv", "--pairs-csv", "p.csv")
    assert code == 0
    told = json.loads(output)
    assert [group["statuses"] for group in told["groups"]] == [{"succeeded": 2}] * 2
    one = told["groups"][0]
    times = [
        r["timing"]["planning_s"] for r in stored() if r["config"]["planner"]["order"] == one["axes"]["planner.order"]
    ]
    assert one["overall"]["timing.planning_s"]["value"] == pytest.approx(sum(times) / 2)
    assert one["overall"]["timing.planning_s"]["n"] == 2
    (line,) = [
        row
        for row in rows("a.csv")
        if row["column"] == "timing.planning_s" and row["over"] == "overall" and row["planner.order"] == "given"
    ]
    assert (line["unit"], line["n"], line["low"]) == ("s", "2", "")
    assert [row["column"] for row in rows("p.csv")] == [pair["column"] for pair in told["pairs"]]
    assert Path("a.csv").read_text().startswith("planner.order,runs,counted,over,column,unit,value,low,high,n\n")


def test_tables_for_papers(study):
    assert study("report", "results/tiny", "--markdown", "a.md", "--latex", "a.tex")[0] == 0
    markdown, latex = Path("a.md").read_text(), Path("a.tex").read_text()
    assert "| given | 2 | 2 | 2/2 | 100 % [34, 100] |" in markdown
    assert r"given & 2 & 2 & 2/2 & 100 \% [34, 100] &" in latex
    assert latex.count(r"\begin{tabular}") == latex.count(r"\end{tabular}") == latex.count(r"\toprule")
    assert "timing.planning\\_s" in latex


def test_runs_as_parquet(study):
    parquet = pytest.importorskip("pyarrow.parquet")
    assert study("report", "results/tiny", "--parquet", "a.parquet")[0] == 0
    table = parquet.read_table("a.parquet").to_pylist()
    assert {row["run_id"]: row["timing.planning_s"] for row in table} == {
        record["run_id"]: record["timing"]["planning_s"] for record in stored()
    }
    assert {row["config.planner.order"] for row in table} == {"given", "farthest_first"}


def test_a_file_that_cannot_be_written_is_one_line(study):
    code, _, errors = study("report", "results/tiny", "--csv", "no/where.csv")
    assert (code, errors) == (2, "no/where.csv: cannot be written: No such file or directory\n")


def test_rows_by_some_options_only(study):
    code, output, _ = study("report", "results/tiny", "--by", "planner.plugin", "--json")
    assert code == 0
    assert [group["runs"] for group in json.loads(output)["groups"]] == [4]


def test_a_page_is_written_next_to_the_results_or_to_a_given_file(study):
    _, output, _ = study("report", "results/tiny")
    page = Path("results/tiny/report.html").resolve()
    assert output.splitlines()[-1] == f"wrote {page}"
    assert "4 runs: 2 configurations, 2 scenarios." in page.read_text(encoding="utf-8")
    page.unlink()
    assert study("report", "results/tiny", "--html", "here.html", "--json")[0] == 0
    assert Path("here.html").is_file()
    assert study("report", "results/tiny", "--html", "none")[0] == 0
    assert not page.exists()


def test_the_page_links_replays_of_failed_runs_first(mrpbench):
    study = Path("tiny.yaml").read_text().replace("simulator: none", "simulator: kinematic")
    Path("driven.yaml").write_text(study.replace("seed: 0..1", "limits.execution: [60, 0.2]"))
    assert mrpbench("run", "driven.yaml", "seed=0..1", "scenario.robots=2", "--out", "driven")[0] == 0
    ended = {record["run_id"]: record["status"] for record in stored("driven")}
    failed = {run_id for run_id, status in ended.items() if status == "goals_missed"}
    assert failed
    assert mrpbench("report", "driven", "--replays", "1")[0] == 0
    (replay,) = Path("driven").glob("replay-*.html")
    assert any(run_id.startswith(replay.stem.removeprefix("replay-")) for run_id in failed)
    assert mrpbench("report", "driven", "--replays", "0", "--html", "elsewhere.html")[0] == 0
    packed = re.search(r'id="data"[^>]*>([^<]+)<', Path("elsewhere.html").read_text())[1]
    linked = json.loads(zlib.decompress(base64.b64decode(packed)))["replays"]
    assert list(linked.values()) == [f"driven/{replay.name}"]
