"""`mrpbench evidence` and the table of a pull request."""

import json
import shutil
from pathlib import Path

import pytest
from mrpbench_search.evidence.protocol import PROTOCOLS

from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.files.errors import InputError

BLOCKS = {"controllers-1": "controller: pure_pursuit\n", "planners-1": "planner: pbs\n"}


@pytest.mark.parametrize("name", sorted(PROTOCOLS))
def test_protocols_are_studies_of_160_runs(name, tmp_path):
    pytest.importorskip("mrpbench_planners_mapf")
    file = tmp_path / "mine.yaml"
    file.write_text(BLOCKS[name])
    study = read_study(PROTOCOLS[name].study(file))
    assert study.errors == ()
    assert len({point.run_id for point in study.runs}) == 160
    assert set(PROTOCOLS[name].metrics) <= {"succeeded"} | set(study.columns)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("planner: pbs\nworld: office\n", "world: planners-1 does not leave it open"),
        ("controller: dwb\n", "planner: is missing"),
    ],
)
def test_a_candidate_gives_what_the_protocol_leaves_open(tmp_path, text, message):
    file = tmp_path / "mine.yaml"
    file.write_text(text)
    with pytest.raises(InputError, match=message):
        PROTOCOLS["planners-1"].study(file)


def slower(folder, factor):
    """Multiply the costs of the plans in a folder."""
    for shard in Path(folder, "runs").iterdir():
        records = [json.loads(line) for line in shard.read_text().splitlines()]
        for record in records:
            record["metrics"]["planning.sum_of_costs"] *= factor
        shard.write_text("".join(json.dumps(record) + "\n" for record in records))


def test_a_planted_slow_down_of_5_percent_is_found_and_equal_runs_are_identical(mrpbench):
    assert mrpbench("run", "tiny.yaml", "seed=0..11", "metrics=[planning]", "--out", "a")[0] == 0
    for copy in ("b", "c"):
        shutil.copytree("a", copy)
    slower("c", 1.05)
    words = ("--metrics", "succeeded,planning.sum_of_costs", "--markdown")
    code, output, _ = mrpbench("compare", "a", "b", *words)
    assert code == 0
    assert output.startswith("## A and B are identical\n")
    code, output, _ = mrpbench("compare", "a", "c", *words)
    assert code == 1
    (row,) = (line for line in output.splitlines() if "sum_of_costs" in line)
    assert "| worse |" in row
