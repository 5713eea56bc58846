"""The comparison with published results of POGEMA's benchmark, on an excerpt of it."""

import json
import runpy
from pathlib import Path

import pytest

from mrpbench_core.api import InputError

TABLES = runpy.run_path(str(Path(__file__).parents[4] / "benchmarks" / "pogema_tables.py"))
SET = "03-warehouse"
RANDOM = TABLES["EXCERPT"] / "raw_data_MAPF" / "01-random" / "LaCAM.json"


def compared(**options):
    return TABLES["compare"](TABLES["EXCERPT"], SET, "LaCAM", "lacam", **options)


def test_planners_are_compared_with_what_is_published():
    pairs = compared(robots=32, seeds=2)
    first, second = pairs.pop(32)
    assert not pairs
    assert first.published == {"CSR": 1.0, "SoC": 1002.0, "makespan": 50.0}
    assert first.contradicted  # a robot has to go from (3, 38) to (26, 4)
    assert not second.contradicted
    assert first.ours["CSR"] == second.ours["CSR"] == 1.0
    assert first.ours["makespan"] >= 57
    assert second.ours["makespan"] == second.published["makespan"] == 59
    assert 940 <= second.ours["SoC"] <= second.published["SoC"]


def test_missing_results_are_one_line():
    with pytest.raises(InputError, match=r"RHCR\.json: there is no such file \(there are: LaCAM\)"):
        next(TABLES["published"](TABLES["EXCERPT"], SET, "RHCR"))


def test_the_published_results_of_random_maps_are_compared_in_pairs():
    (problem,) = json.loads(RANDOM.read_text())[:1]
    pair = TABLES["Pair"](ours=problem["metrics"] | {"SoC": 82}, published=problem["metrics"], contradicted=False)
    assert TABLES["paired"]([pair]) == "SoC in pairs: 1 of 1 equal, 0.0 % more"
    dearer = TABLES["Pair"](ours=problem["metrics"] | {"SoC": 90.2}, published=problem["metrics"], contradicted=False)
    assert TABLES["paired"]([pair, dearer]).startswith("SoC in pairs: 1 of 2 equal, 5.0 ±")
