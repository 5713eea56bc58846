"""Two results folders, paired."""

import sys

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.report.folder_comparison import compare_folders


@pytest.fixture
def two(results, record):
    """Return a function that compares costs per seed of A and of B, for each planner."""

    def compare(first, second, **options):
        folders = [
            results(
                [record(planner, seed, cost=cost) for planner in costs for seed, cost in costs[planner].items()], name
            )
            for name, costs in (("a", first), ("b", second))
        ]
        return compare_folders(*folders, metrics=["planning.cost"], **options)

    return compare


def costs(base, seeds=range(8), step=0.0):
    return {seed: base + seed + step * (seed + 1) for seed in seeds}


def of(found, column="planning.cost"):
    return {entry.setting: entry for entry in found.comparisons if entry.column.name == column}


def test_the_same_results_do_not_differ(two):
    found = two({"cbs": costs(5.0)}, {"cbs": costs(5.0)})
    entry = of(found)[""]
    assert (entry.paired.difference.n, entry.paired.ties, entry.verdict, found.differing) == (8, 8, "not shown", {})


def test_the_direction_of_a_column_decides_what_is_worse(two):
    found = two({"cbs": costs(5.0)}, {"cbs": costs(5.0, step=0.1)})
    assert of(found)[""].verdict == "worse"
    assert of(two({"cbs": costs(5.0, step=0.1)}, {"cbs": costs(5.0)}))[""].verdict == "better"
    assert of(found, "succeeded")[""].verdict == "not shown"


def test_configurations_are_matched_and_the_others_named(two):
    found = two({"astar": costs(3.0), "cbs": costs(5.0)}, {"cbs": costs(5.0, step=0.1), "ecbs": costs(6.0)})
    assert list(of(found)) == ["cbs"]
    assert found.unmatched == (("astar",), ("ecbs",))


def test_options_that_differ_between_the_folders_are_compared(two):
    found = two({"cbs": costs(5.0)}, {"ecbs": costs(5.0, step=-0.1)})
    assert of(found)[""].verdict == "better"
    assert found.differing == {"planner.plugin": ("cbs", "ecbs")}


def test_scenarios_that_only_one_has_are_counted(two):
    entry = of(two({"cbs": costs(5.0, range(10))}, {"cbs": costs(5.0, range(4, 11))}))[""]
    assert (entry.paired.difference.n, entry.unpaired) == (6, (4, 1))


def test_nothing_in_common_is_said(two):
    with pytest.raises(InputError, match="no scenario in common"):
        two({"cbs": costs(5.0, range(4))}, {"cbs": costs(5.0, range(4, 8))})
    with pytest.raises(InputError, match="no configuration in common"):
        two({"a": costs(5.0), "b": costs(5.0)}, {"c": costs(5.0), "d": costs(5.0)})


def test_versions_that_differ_are_told(results, record):
    one = results([record()], "a", "versions: {mrpbench-core: 0.1.0}\nmachine: {processor: slow}\n")
    two = results([record()], "b", "versions: {mrpbench-core: 0.2.0}\nmachine: {processor: slow}\n")
    assert compare_folders(one, two).differing == {"mrpbench-core": ("0.1.0", "0.2.0")}


def test_comparing_needs_scipy(results, record, monkeypatch):
    folder = results([record("a", 0)])
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(InputError, match=r"^comparing needs SciPy \(`pip install 'mrpbench\[statistics\]'`\)$"):
        compare_folders(folder, folder)
