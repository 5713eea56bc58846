"""Groups of runs, and the settings in which they can be compared."""

from mrpbench_core.report.estimation.groups import differing_factors, find_settings, group_runs
from mrpbench_core.report.reading.runs import read_runs


def study(record, planners=("astar", "cbs"), robots=(5, 9), seeds=range(3)):
    return [
        record(
            planner,
            seed,
            scenario=f"{count}-{seed}",
            config={"scenario": {"plugin": "random", "robots": count}},
        )
        for planner in planners
        for count in robots
        for seed in seeds
    ]


def test_seeds_and_repeats_are_samples_of_one_group(results, record):
    runs = read_runs([results([record(seed=seed, repeat=repeat) for seed in (0, 1) for repeat in (0, 1)])])
    (group,) = group_runs(runs)
    assert (group.axes, len(group.members)) == ({}, 4)


def test_groups_that_share_scenarios_are_a_setting(results, record):
    runs = read_runs([results(study(record))])
    settings = find_settings(runs, group_runs(runs))
    assert [(setting.name, setting.names) for setting in settings] == [
        ("robots=5", ("astar", "cbs")),
        ("robots=9", ("astar", "cbs")),
    ]


def test_groups_can_pool_other_options(results, record):
    runs = read_runs([results(study(record))])
    (setting,) = find_settings(runs, group_runs(runs, ["planner"]))
    assert setting.names == ("astar", "cbs")
    assert [len(group.members) for group in setting.groups] == [6, 6]


def test_infeasible_and_skipped_runs_do_not_count(results, record):
    statuses = ["succeeded", "plan_timeout", "scenario_infeasible", "skipped"]
    runs = read_runs([results([record(seed=seed, status=status) for seed, status in enumerate(statuses)])])
    (group,) = group_runs(runs)
    assert (len(group.members), len(group.counted)) == (4, 2)
    assert group.statuses(runs) == dict.fromkeys(statuses, 1)


def test_repeats_of_a_scenario_are_averaged(results, record):
    runs = read_runs([results([record(repeat=0, cost=1.0), record(repeat=1, cost=2.0), record(seed=1, cost=5.0)])])
    (setting,) = find_settings(runs, group_runs(runs))
    _, means, count = setting.groups[0].by_unit(runs, setting.units, "planning.cost")
    assert (means.tolist(), count) == ([1.5, 5.0], 3)


def test_a_planner_and_its_options_are_one_choice():
    one = {"planner.plugin": "ecbs", "planner.w": 1.2, "scenario.robots": 5}
    assert differing_factors(one, {"planner.plugin": "cbs", "scenario.robots": 5}) == ["planner"]
    assert differing_factors(one, {"planner.plugin": "cbs", "scenario.robots": 9}) == ["planner", "scenario"]


def test_runs_that_only_plan_are_no_competitors_of_runs_that_drive(results, record):
    simulators = ("none", {"plugin": "planar"})
    both = [
        record(planner, scenario="1", config={"simulator": simulator})
        for planner, simulator in zip(("cbs", "astar"), simulators, strict=True)
    ]
    runs = read_runs([results(both)])
    assert [len(setting.groups) for setting in find_settings(runs, group_runs(runs))] == [1, 1]
