"""`mrpbench compare A B`."""

import json
import shutil
from pathlib import Path


def worsen(folder, factor):
    """Multiply all planning times of the records in a folder."""
    for shard in Path(folder, "runs").iterdir():
        records = [json.loads(line) for line in shard.read_text().splitlines()]
        for record in records:
            record["timing"]["planning_s"] *= factor
        shard.write_text("".join(json.dumps(record) + "\n" for record in records))


def test_the_exit_code_says_whether_something_got_worse(mrpbench):
    assert mrpbench("run", "tiny.yaml", "seed=0..7", "--out", "a")[0] == 0
    for copy in ("b", "c"):
        shutil.copytree("a", copy)
    worsen("b", 0.0)
    worsen("c", 1000.0)
    code, output, errors = mrpbench("compare", "a", "b")
    assert (code, errors) == (0, "")
    assert "better in 1, worse in 0" in output
    assert "A: a, 8 runs" in output
    code, output, _ = mrpbench("compare", "a", "c", "--json", "--csv", "table.csv")
    assert code == 1
    told = json.loads(output)
    assert told["verdicts"]["worse"] == 1
    worse = [entry for entry in told["comparisons"] if entry["verdict"] == "worse"]
    assert [(entry["column"], entry["pairs"], entry["more"]) for entry in worse] == [("timing.planning_par2_s", 8, 8)]
    assert worse[0]["p"] == 2 / 2**8
    assert len(Path("table.csv").read_text().splitlines()) == len(told["comparisons"]) + 1


def test_folders_without_anything_in_common_are_exit_code_2(mrpbench):
    mrpbench("run", "tiny.yaml", "seed=0..1", "--out", "a")
    mrpbench("run", "tiny.yaml", "seed=2..3", "--out", "b")
    code, _, errors = mrpbench("compare", "a", "b")
    assert code == 2
    assert "no scenario in common" in errors
    assert len(errors.splitlines()) == 1
