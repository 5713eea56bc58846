"""The comparison with published results of POGEMA's benchmark, on an excerpt of it."""

import json
import runpy
from pathlib import Path

import pytest

from mrpbench_core.api import InputError

TABLES = runpy.run_path(str(Path(__file__).parents[4] / "benchmarks" / "pogema_tables.py"))
EXCERPT = TABLES["EXCERPT"]


def test_planners_are_compared_with_what_is_published():
    ours = TABLES["compare"](EXCERPT, "03-warehouse", "lacam", 32, 2)
    theirs = TABLES["published"](EXCERPT, "03-warehouse")
    first, second = ours
    assert (first, second) == (("wfi_warehouse", 0, 32), ("wfi_warehouse", 1, 32))
    assert theirs[first]["SoC"] == 1002
    assert theirs[second]["SoC"] == 1030
    for problem, shortest, longest in ((first, 995, 50), (second, 1025, 59)):  # sums and longest of the shortest ways
        assert ours[problem]["CSR"] == 1.0
        assert shortest <= ours[problem]["SoC"] <= 1.01 * theirs[problem]["SoC"]
        assert theirs[problem]["makespan"] == longest <= ours[problem]["makespan"] <= 1.1 * longest
    assert "of 2 equal" in TABLES["paired"](ours, theirs)


def test_a_run_without_a_plan_counts_all_steps(tmp_path):
    experiment = tmp_path / "algorithms" / "experiments" / "swap"
    experiment.mkdir(parents=True)
    (experiment / "maps.yaml").write_text("{aisle: '....'}")
    scenario = {"map_name": "aisle", "seed": 0, "agents_xy": [[0, 0], [0, 3]], "targets_xy": [[0, 3], [0, 0]]}
    written = {"environment": {"max_episode_steps": 16}, "scenarios": {"Scenario-0": scenario}}
    (experiment / "swap-mapf.yaml").write_text(json.dumps(written))
    (metrics,) = TABLES["compare"](tmp_path, "swap", "pibt", 2).values()
    assert metrics == {"CSR": 0.0, "SoC": 32, "makespan": 16}


def test_missing_results_are_one_line():
    with pytest.raises(InputError, match=r"there is no such file \(there are results of 01-random, 02-mazes, 03-ware"):
        TABLES["published"](EXCERPT, "04-movingai")


def test_costs_are_compared_where_both_solve():
    def run(cost, solved=1.0):
        return {"CSR": solved, "SoC": cost}

    ours = {("map", seed, 8): run(cost) for seed, cost in enumerate((82, 79.2, 90))}
    theirs = {("map", 0, 8): run(82), ("map", 1, 8): run(72), ("map", 2, 8): run(1024, 0.0), ("map", 3, 8): run(80)}
    text = TABLES["paired"](ours, theirs)
    assert text.startswith("SoC in pairs: 1 of 2 equal, 5.0 ±")
    assert text.endswith("published runs solve 2 of 3")
