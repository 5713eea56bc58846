"""Records grouped by what sets their configurations apart."""

from mrpbench_core.store.groups import group


def record(planner, seed=0, status="succeeded", cost=1.0, **config):
    return {
        "run_id": f"{planner}{seed}{config}",
        "status": status,
        "seed": seed,
        "repeat": 0,
        "config": {"planner": planner, "seed": seed, "name": "x", **config},
        "metrics": {"planning.cost": cost},
        "timing": {},
    }


CBS, ECBS = {"plugin": "cbs"}, {"plugin": "ecbs", "w": 1.2}


def test_seeds_are_samples_of_one_group():
    (found,) = group([record(CBS, 0, cost=1.0), record(CBS, 1, cost=4.0)])
    assert (found.runs, found.axes, found.mean("planning.cost")) == (2, {}, (2.5, 2))


def test_options_that_only_follow_from_the_plugin_are_left_out():
    groups = group([record(CBS), record(ECBS)])
    assert [found.axes for found in groups] == [{"planner.plugin": "cbs"}, {"planner.plugin": "ecbs"}]


def test_an_option_that_varies_within_a_plugin_stays():
    groups = group([record(CBS), record(ECBS), record({**ECBS, "w": 1.5})])
    assert [found.axes.get("planner.w") for found in groups] == [None, 1.2, 1.5]


def test_a_plain_option_that_varies_stays():
    groups = group([record(CBS, control_rate=20.0), record(CBS, control_rate=10.0)])
    assert [found.axes for found in groups] == [{"control_rate": 20.0}, {"control_rate": 10.0}]


def test_infeasible_and_skipped_runs_leave_the_denominator():
    statuses = ["succeeded", "plan_timeout", "scenario_infeasible", "skipped"]
    (found,) = group([record(CBS, seed, status) for seed, status in enumerate(statuses)])
    assert (found.runs, found.counted) == (4, 2)
