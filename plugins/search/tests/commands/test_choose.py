"""`mrpbench choose STUDY`."""

import json
from pathlib import Path

import pytest
from mrpbench_search.choosing.answer import CandidateResult, sentence
from mrpbench_search.choosing.race import Standing
from mrpbench_search.choosing.search import Rules

from mrpbench_core.api.metric import Column
from mrpbench_core.store.results import load

STUDY = """\
name: room
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
simulator: none
metrics: [planning]
recording: {keep: none}
matrix:
  planner: [{plugin: example, order: given}, {plugin: example, order: farthest_first}]
  seed: 0..19
"""


@pytest.fixture
def room(mrpbench):
    Path("room.yaml").write_text(STUDY)
    return mrpbench


def test_equal_candidates_are_as_good_and_nothing_is_done_twice(room):
    code, output, errors = room("choose", "room.yaml", "--json")
    assert code == 0, errors
    told = json.loads(output)
    (setting,) = told["settings"]
    first, second = (row["candidate"] for row in setting["candidates"])
    assert setting["answer"] == f"{first}; {second} is as good within 2 %"
    assert told["metric"] == "planning.sum_of_costs"
    assert told["runs"] == len(load("results/room")) < told["runs_of_study"] == 40
    code, again, errors = room("choose", "room.yaml", "--json")
    assert (code, again) == (0, output)
    assert "[1/" not in errors


def test_a_budget_ends_the_race_before_a_step_that_exceeds_it(room):
    code, output, _ = room("choose", "room.yaml", "--budget", "10runs")
    assert code == 1
    assert "the search ended before: the budget is spent" in output
    assert "room: nothing is decided" in output


def test_what_is_not_decided_names_the_metric():
    rows = [
        CandidateResult(candidate=name, standing=standing, seeds=9, failed=0, mean=2.0, change=change)
        for name, standing, change in (
            ("a", Standing.BEST, None),
            ("b", Standing.OPEN, 0.092),
            ("c", Standing.OPEN, None),
        )
    ]
    rules = Rules(column=Column("planning.sum_of_costs", "s", "lower", ""), level=0.05, margin=0.02)
    undecided = "b (9.2 % more sum_of_costs) and c (no seed with a sum_of_costs of both)"
    assert sentence(rows, rules) == f"a leads; not decided after 9 seeds: {undecided}"


def test_shards_of_a_step_are_merged_by_copying(room):
    for part in "01":
        code, output, _ = room("choose", "room.yaml", "--shard", f"{part}/2", "--out", "parts")
    assert code == 0  # the second shard finds the runs of the first one in its folder
    assert "is as good within 2 %" in output


def test_a_shard_alone_says_what_it_lacks(room):
    code, output, _ = room("choose", "room.yaml", "--shard", "0/2")
    assert code == 1
    assert "of other shards are not in" in output


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("seed=0..2",), "seed: 3 seeds cannot decide between 2 candidates"),
        (("planner=example",), "the study has one candidate"),
        (("--candidates", "nosuch"), "the study has one candidate: none of nosuch varies"),
        (("--metric", "planning.sum"), "the study has no such column"),
        (("--margin", "2"), "--margin 2: between 0 and 1"),
        (("--budget", "soon"), "--budget soon: expected a time"),
        (("metrics=[]",), "--metric: the study measures none of"),
    ],
)
def test_mistakes_are_one_line(room, words, message):
    code, _, errors = room("choose", "room.yaml", *words)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1
