"""`mrpbench evidence` and the table of a pull request."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mrpbench_search.evidence.protocol import PROTOCOLS, Protocol
from scipy.stats import binom

from mrpbench_core.engine.study.reading import read_study
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load
from mrpbench_core.report.statistics.paired import adjust, compare_values
from mrpbench_core.report.statistics.sample_size import POWER, pairs_needed

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


ROOM = """\
name: room-1
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
simulator: none
metrics: [planning]
recording: {keep: none}
matrix: {seed: 0..11}
"""
SLOW = """\
import attrs
import numpy as np
from mrpbench_core.api import Plan, Planner, Promise
from mrpbench_planners_example import Example


@attrs.frozen(kw_only=True)
class Slow(Planner):
    promises = frozenset({Promise.CONFLICT_FREE})

    def plan(self, problem, budget):
        found = Example().plan(problem, budget)
        if found.plan is None:
            return found
        late = [
            attrs.evolve(path, edge=np.append(-1, path.edge).astype("i4"), enter=np.append(0, path.enter + 1),
                         leave=np.append(1, path.leave + 1))
            for path in found.plan.paths
        ]
        return attrs.evolve(found, plan=Plan(paths=tuple(late)))
"""


@pytest.fixture
def room(mrpbench, monkeypatch, tmp_path):
    """Return the command with a protocol of 12 short runs, and candidates."""
    pytest.importorskip("mrpbench_planners_example")
    metrics = ("succeeded", "planning.sum_of_costs")
    protocol = Protocol(name="room-1", needs="planner", allows=("planner",), metrics=metrics, settings=())
    monkeypatch.setitem(PROTOCOLS, "room-1", protocol)
    monkeypatch.setattr("mrpbench_search.evidence.protocol.FOLDER", tmp_path)
    Path("room-1.yaml").write_text(ROOM)
    Path("slow.py").write_text(SLOW)
    Path("base.yaml").write_text("planner: example\n")
    Path("slow.yaml").write_text("planner: ./slow.py:Slow\n")
    return mrpbench


def test_the_same_file_twice_is_identical_and_a_slower_planner_is_worse(room):
    code, output, errors = room("evidence", "base.yaml", "base.yaml", "--protocol", "room-1", "--out", "same")
    assert code == 0, errors
    assert output.startswith("## A and B are identical\n")  # nothing else, as the action writes it into a summary
    assert "## By setting\n" in output
    assert "[12/12]" in errors
    code, output, errors = room("evidence", "base.yaml", "slow.yaml", "--protocol", "room-1", "--out", "slower")
    assert code == 1, errors
    (row,) = {line for line in output.splitlines() if "sum_of_costs" in line}
    assert "| worse |" in row


def test_what_is_wrong_with_a_candidate_names_its_file(room):
    Path("wrong.yaml").write_text("planner: {plugin: example, speed: 2}\n")
    code, _, errors = room("evidence", "base.yaml", "wrong.yaml", "--protocol", "room-1")
    assert code == 2
    assert errors.startswith("wrong.yaml: planner.speed: unknown option")
    assert len(errors.splitlines()) == 1


def test_the_steps_of_the_action_write_the_table_of_both_candidates(room, tmp_path):
    action = load(Path(__file__).parents[2] / "action" / "action.yml").data
    install, compare = (step["run"] for step in action["runs"]["steps"])
    assert install == "pip install 'mrpbench[search]'"
    command = f"{sys.executable} -m mrpbench_core.cli.main"
    script = tmp_path / "mrpbench"
    script.write_text(f"#!/bin/sh\nexec {command} compare --by '' --markdown --metrics planning.sum_of_costs a b\n")
    script.chmod(0o755)
    assert room("run", "room-1.yaml", "planner=example", "--out", "a")[0] == 0
    shutil.copytree("a", "b")
    slower("b", 1.05)
    summary = tmp_path / "summary.md"
    names = {"BASE": "base.yaml", "HEAD": "slow.yaml", "PROTOCOL": "planners-1", "GITHUB_STEP_SUMMARY": str(summary)}
    env = os.environ | names | {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", compare], env=env, capture_output=True, text=True)
    assert done.returncode == 1, done.stderr  # the job fails: something is worse
    assert summary.read_text() == done.stdout
    assert "| worse |" in done.stdout


def noisy(rng, pairs, factor=1.0):
    """Durations of the same scenarios of two candidates with independent noise, the second one slower."""
    scenario = rng.gamma(9, 10, pairs)
    return (scenario * np.exp(0.05 * rng.normal(size=pairs)) * scale for scale in (1.0, factor))


def test_runs_that_differ_by_noise_alone_are_rarely_called_better_or_worse():
    rng = np.random.default_rng(0)
    families = [[compare_values(*noisy(rng, 40)) for _ in range(3)] for _ in range(50)]
    shown = sum(min(adjust(family)) < 0.05 for family in families)
    assert shown <= binom.ppf(0.999, 50, 0.05)


def test_a_slow_down_of_5_percent_is_found_with_as_many_pairs_as_were_asked_for():
    rng, shown = np.random.default_rng(1), 0
    for _ in range(30):
        first, second = noisy(rng, 40)
        pairs = pairs_needed(second - first, 0.05 * first.mean(), 0.05)
        shown += compare_values(*noisy(rng, pairs, 1.05)).p < 0.05
    assert shown >= binom.ppf(0.001, 30, POWER)
