"""The numbers of a report: by hand on a few records, and recomputed with pandas as a reviewer would."""

import sys

import pandas as pd
import pytest
from scipy import stats

from mrpbench_core.files.errors import InputError
from mrpbench_core.report.report import make_report


def numbers(report, setting=0):
    return dict(zip(report.settings[setting].names, report.numbers[setting], strict=True))


def test_success_is_overall_and_normalised(results, record):
    """Of four scenarios `b` has a plan for three, of which `a` drives two well: 2/4 overall, 2/3 in common."""
    ends = {
        "a": ["succeeded", "succeeded", "goals_missed", "goals_missed"],
        "b": ["succeeded", "succeeded", "succeeded", "plan_timeout"],
    }
    found = make_report([results([record(p, seed, end) for p in ends for seed, end in enumerate(ends[p])])])
    a, b = numbers(found)["a"], numbers(found)["b"]
    assert (a.overall["succeeded"].value, a.overall["succeeded"].n) == (0.5, 4)
    assert (b.overall["succeeded"].value, b.overall["planned"].value) == (0.75, 0.75)
    assert (a.common["succeeded"].value, a.common["succeeded"].n) == (pytest.approx(2 / 3), 3)
    assert (b.common["succeeded"].value, b.common["succeeded"].n) == (1.0, 3)


def test_means_in_common_are_over_scenarios_for_which_all_have_a_value(results, record):
    costs = {"a": [1.0, 2.0, 30.0], "b": [2.0, 3.0, None]}
    records = [record(p, seed, cost=costs[p][seed]) for p in costs for seed in range(3)]
    found = make_report([results(records)], ["planning.cost"])
    a, b = numbers(found)["a"], numbers(found)["b"]
    assert (a.overall["planning.cost"].value, a.overall["planning.cost"].n) == (11.0, 3)
    assert (a.common["planning.cost"].value, a.common["planning.cost"].n) == (1.5, 2)
    assert (b.common["planning.cost"].value, b.common["planning.cost"].n) == (2.5, 2)


def test_a_skipped_planner_takes_nothing_from_the_others(results, record):
    records = [record("a", seed) for seed in range(3)] + [record("b", seed, "skipped") for seed in range(3)]
    found = make_report([results(records)])
    assert numbers(found)["b"].overall["succeeded"] is None
    assert numbers(found)["a"].common["succeeded"].n == 3
    assert "n/a" in found.tables()[0].rows[1]


def test_one_that_never_plans_leaves_nothing_in_common(results, record):
    records = [record("a", seed, cost=1.0) for seed in range(3)]
    records += [record("b", seed, "plan_timeout") for seed in range(3)]
    found = make_report([results(records)], ["planning.cost"])
    assert numbers(found)["a"].common["planning.cost"] is None


def test_one_that_is_not_executed_is_not_asked_for_executions(results, record):
    driven = [record("a", seed, metrics={"execution.duration_s": 5.0 + seed}) for seed in range(3)]
    planned = [record("b", seed, metrics={"execution.duration_s": None}) for seed in range(3)]
    found = make_report([results(driven + planned)], ["execution.duration_s"])
    assert numbers(found)["a"].common["execution.duration_s"].n == 3


def test_pairs_are_made_on_common_scenarios_only(results, record):
    records = [record("a", seed, cost=float(seed)) for seed in range(8)]
    records += [record("b", seed, cost=seed + 1.0 + seed / 10) for seed in range(2, 12)]
    (cost,) = [
        c for c in make_report([results(records)], ["planning.cost"]).comparisons if c.column.name == "planning.cost"
    ]
    assert (cost.paired.difference.n, cost.unpaired) == (6, (2, 4))
    assert cost.paired.difference.value == pytest.approx(1.45)
    assert cost.paired.p == pytest.approx(2 / 2**6)
    assert cost.verdict == "worse"  # lower is better; the only test that could be significant


def test_a_mean_that_points_the_other_way_is_reported(results, record):
    """Nineteen pairs a little dearer and one far cheaper: worse by the ranks, cheaper on average."""
    records = [record("a", seed, cost=500.0 if seed == 19 else 10.0) for seed in range(20)]
    records += [record("b", seed, cost=100.0 if seed == 19 else 11.0 + seed) for seed in range(20)]
    found = make_report([results(records)], ["planning.cost"])
    (cost,) = [c for c in found.comparisons if c.column.name == "planning.cost"]
    assert cost.paired.difference.value < 0 < cost.paired.effect
    assert (cost.is_mixed, cost.verdict) == (True, "worse")
    assert "worse, mean disagrees" in found.tables()[-1].rows[-1]


def test_only_groups_that_differ_in_one_choice_are_compared(results, record):
    def entry(planner, rate):
        return [
            record(planner, seed, tag=rate, config={"planner": {"plugin": planner}, "control_rate": rate})
            for seed in range(3)
        ]

    found = make_report([results(entry("a", 10) + entry("a", 20) + entry("b", 10))])
    compared = {(c.first, c.second) for c in found.comparisons}
    assert compared == {("control_rate=10 a", "control_rate=20 a"), ("control_rate=10 a", "control_rate=10 b")}


def test_a_column_that_no_run_has_is_refused(results, record):
    with pytest.raises(InputError, match=r"did you mean 'planning\.cost'"):
        make_report([results([record(cost=1.0)])], ["planning.costs"])


def test_a_reviewer_recomputes_the_numbers_from_the_lines(results, record, tmp_path):
    """Lines of docs/explanation/statistics.md, on a study with repeats, failures, and scenarios that only one has."""
    records = []
    for planner, slow in (("a", 0.0), ("b", 0.7)):
        for seed in range(12):
            for repeat in range(3):
                failed = planner == "b" and seed in (3, 7) and repeat != 1
                value = None if failed else 10.0 + seed % 5 + slow * (seed % 3) + 0.1 * repeat
                status = "plan_timeout" if failed else "succeeded"
                records.append(record(planner, seed, status, repeat=repeat, cost=value))
    records.append(record("a", 99, "scenario_infeasible"))
    folder = results(records).folder.path
    found = make_report([results(records)], ["planning.cost"])

    files = (folder / "runs").glob("*.jsonl")
    lines = pd.concat((pd.read_json(file, lines=True) for file in files), ignore_index=True)
    runs = pd.concat([lines.drop(columns="metrics"), pd.json_normalize(lines["metrics"])], axis=1)
    runs = runs.sort_values("attempt").drop_duplicates("run_id", keep="last")
    runs = runs[~runs["status"].isin(["scenario_infeasible", "skipped"])]
    runs["planner"] = [config["planner"]["plugin"] for config in runs["config"]]
    runs["succeeded"] = runs["status"] == "succeeded"
    by_scenario = runs.groupby(["planner", "scenario_id"])[["succeeded", "planning.cost"]].mean()
    overall = by_scenario.groupby("planner").mean()
    pairs = by_scenario["planning.cost"].unstack("planner").dropna()
    p = stats.wilcoxon((pairs["b"] - pairs["a"]).loc[lambda d: d.abs() > 1e-9]).pvalue

    for planner, entry in numbers(found).items():
        for column in ("succeeded", "planning.cost"):
            assert entry.overall[column].value == pytest.approx(overall.loc[planner, column])
        assert entry.common["planning.cost"].value == pytest.approx(pairs[planner].mean())
        assert entry.common["planning.cost"].n == len(pairs)
    (cost,) = [c for c in found.comparisons if c.column.name == "planning.cost"]
    assert cost.paired.difference.value == pytest.approx((pairs["b"] - pairs["a"]).mean())
    assert cost.paired.p == pytest.approx(p)


def test_localizers_that_were_given_true_poses_are_marked_in_every_table(results, record):
    def run(localizer, seed, **more):
        config = {"localizer": {"plugin": localizer}, "grant_truth": True}
        return record(seed=seed, config=config, tag=localizer, cost=1.0, **more)

    records = [run("amcl", seed) for seed in range(2)] + [run("seer", seed, true_poses="seer") for seed in range(2)]
    outcome, means, *_ = make_report([results(records)], ["planning.cost"]).tables()
    assert [row[0] for row in outcome.rows] == [row[0] for row in means.rows] == ["amcl", "seer (true poses)"]
    assert outcome.note.endswith("True poses were given (grant_truth) to the localizer seer in 2 of 4 runs.")


def test_the_heading_says_where_an_assigner_changed_given_goals(results, record):
    kept = make_report([results([record(seed=seed) for seed in range(3)], "kept")]).tables()[0]
    assert kept.title == "How the runs ended"
    changed = [record(seed=0), record(seed=1, reassigned=2), record(seed=2, reassigned=4)]
    title = make_report([results(changed, "changed")]).tables()[0].title
    assert title == "How the runs ended (the assigner changed the scenario's goals in 2 of 3 runs)"


def test_without_scipy_only_the_paired_tests_are_missing(results, record, monkeypatch):
    folder = results([record(p, seed, cost=1.0 + seed) for p in ("a", "b") for seed in range(6)])
    full = make_report([folder], ["planning.cost"])
    monkeypatch.setitem(sys.modules, "scipy", None)
    found = make_report([folder], ["planning.cost"])
    assert found.numbers == full.numbers
    assert numbers(found)["a"].overall["planning.cost"].has_interval
    *others, pairs = found.tables()
    assert [table.key for table in others] == [table.key for table in full.tables()][:-1]
    assert (pairs.key, pairs.rows) == ("pairs", ())
    assert pairs.note == "Paired comparisons need SciPy: `pip install 'mrpbench[statistics]'` installs it."
    assert "pairs" not in [table.key for table in make_report([results([record("a", 0)])]).tables()]
