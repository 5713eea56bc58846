"""Records as columns."""

import tracemalloc

import numpy as np

from mrpbench_core.report.reading.runs import PAR2, read_runs


def test_a_run_without_a_plan_has_no_planning_time_but_a_penalised_one(results, record):
    failed = record(seed=1, status="plan_timeout", took=10.02)
    crashed = record(seed=2, status="crashed", error={"stage": "planning", "message": "boom"})
    driving = record(seed=3, status="crashed", took=2.0, error={"stage": "execution", "message": "boom"})
    runs = read_runs([results([record(took=1.0), failed, crashed, driving])])
    assert runs.values["planned"].tolist() == [1, 0, 0, 1]
    assert np.allclose(runs.values["timing.planning_s"], [1, np.nan, np.nan, 2], equal_nan=True)
    assert runs.values[PAR2].tolist() == [1, 20, 20, 2]
    assert runs.message == ["", "", "boom", "boom"]


def test_yes_and_no_are_told_from_numbers(results, record):
    runs = read_runs([results([record(cost=1), record(seed=1, cost=0)])])
    assert {"succeeded", "planned", "planning.solved", "timing.clock_bound"} == runs.flags


def test_null_is_not_a_number(results, record):
    runs = read_runs([results([record(), record(seed=1, cost=3.0)])])
    assert np.isnan(runs.values["planning.cost"][0])
    assert runs.values["planning.cost"][1] == 3.0


def test_records_of_a_metric_that_is_called_timing_are_read(results, record):
    metrics = {"planning.cost": 3.0, "timing.planning_s": 7.0}
    runs = read_runs([results([record(seed=seed, metrics=metrics) for seed in range(3)])])
    assert {len(values) for values in runs.values.values()} == {3}


def test_only_the_requested_columns_are_kept(results, record):
    runs = read_runs([results([record(cost=1.0)])], ["planning.cost"])
    assert set(runs.values) == {"succeeded", "planned", "planning.cost"}


def test_of_a_run_in_two_folders_the_later_counts(results, record):
    one = results([record(cost=1.0), record(seed=1, cost=1.0)], "one")
    two = results([record(cost=2.0)], "two")
    runs = read_runs([one, two])
    assert runs.values["planning.cost"].tolist() == [1.0, 2.0]
    assert runs.folder.tolist() == [0, 1]


def test_scenarios_are_the_samples_unless_there_is_but_one(results, record):
    several = read_runs([results([record(seed=seed, repeat=repeat) for seed in (0, 1) for repeat in (0, 1)])])
    units, word = several.units([np.arange(4)])
    assert (units.tolist(), word) == ([0, 0, 1, 1], "scenarios")
    one = read_runs([results([record(repeat=repeat, scenario="same") for repeat in (0, 1, 2)], "one")])
    units, word = one.units([np.arange(3)])
    assert (len(set(units.tolist())), word) == (3, "runs")


def test_runs_whose_scenario_was_never_drawn_stand_alone(results, record):
    lost = [record(seed=seed, status="crashed", scenario=None) for seed in (1, 2)]
    runs = read_runs([results([record(), *lost])])
    units, _ = runs.units([np.arange(3)])
    assert len(set(units.tolist())) == 3


def test_of_attempts_the_highest_counts_whether_records_are_read_once_or_again(results, record):
    again = [record(cost=1.0) | {"attempt": 2}, record(seed=1, cost=5.0), record(cost=2.0) | {"attempt": 3}]
    folder = results([record(cost=7.0), *again, record(cost=9.0) | {"attempt": 1}])
    for _ in range(2):
        runs = read_runs([folder])
        assert runs.values["planning.cost"].tolist() == [5.0, 2.0]
        assert len(folder) == 2


def test_memory_grows_by_less_than_a_kilobyte_with_each_run(results, record):
    def peak(count):
        folder = results([record(seed=seed, cost=float(seed)) for seed in range(count)], f"results-{count}")
        tracemalloc.start()
        try:
            assert len(read_runs([folder])) == len(folder) == count
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    peak(10)  # imports and caches
    assert (peak(3000) - peak(1000)) / 2000 < 1000


def test_worlds_with_the_same_starts_and_goals_are_several_scenarios_of_one_group(results, record):
    def field(number, planner):
        return record(planner, scenario="a", config={"world": {"plugin": "barn", "index": number}}, tag=str(number))

    runs = read_runs([results([field(number, planner) for planner in ("astar", "cbs") for number in (0, 3, 6)])])
    assert runs.units([np.arange(3), np.arange(3, 6)])[1] == "scenarios"
    assert runs.units([np.arange(3), np.arange(3, 6)])[0].tolist() == [0, 1, 2, 0, 1, 2]
    assert len(set(runs.units([np.arange(1), np.arange(1, 2)])[0].tolist())) == 1, "a row for each world: pairs"
