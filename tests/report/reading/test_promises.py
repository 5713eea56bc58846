"""What planners claim, compared across the runs that had the same problem."""

import numpy as np
import pytest

from mrpbench_core.report.reading.runs import PAR2, read_runs
from mrpbench_core.report.report import make_report


@pytest.fixture
def claiming(record):
    """Return a function that makes a record with the claims of its planner."""

    def make(planner, seed=0, status="succeeded", *, problem="p", setting="s", **claims):
        claims = {"cost": None, "lower_bound": None, "factor": None, "assigns": False, "unsolvable": False} | claims
        return record(
            planner, seed, status, cost=claims["cost"], plan={"problem": problem, "setting": setting, **claims}
        )

    return make


def statuses(found):
    return dict(zip((name.partition("-")[0] for name in found.run_id), found.status, strict=True))


def test_an_optimal_planner_that_another_one_undercuts_breaks_its_promise(results, claiming):
    liar, honest = claiming("liar", cost=12, factor=1.0), claiming("honest", cost=10)
    runs = read_runs([results([liar, honest])])
    assert statuses(runs) == {"liar": "promise_broken", "honest": "succeeded"}
    assert runs.message[0] == "promises the least cost and costs 12, but run honest-0-0-5 has a valid plan of cost 10"


@pytest.mark.parametrize(("cost", "status"), [(12, "succeeded"), (13, "promise_broken")])
def test_a_bounded_planner_may_cost_its_factor_of_the_best_known_plan(results, claiming, cost, status):
    runs = read_runs([results([claiming("a", cost=cost, factor=1.2), claiming("b", cost=10)])])
    assert runs.status[0] == status


def test_a_lower_bound_above_a_valid_plan_is_no_proof(results, claiming):
    runs = read_runs([results([claiming("liar", cost=12, lower_bound=11.0), claiming("honest", cost=10)])])
    assert statuses(runs) == {"liar": "promise_broken", "honest": "succeeded"}
    assert runs.message[0] == "claims the lower bound 11, but run honest-0-0-5 has a valid plan of cost 10"


def test_a_problem_with_a_plan_is_not_unsolvable(results, claiming):
    liar = claiming("liar", status="plan_unsolvable", unsolvable=True)
    runs = read_runs([results([liar, claiming("honest", cost=10)])])
    assert runs.status == ["promise_broken", "succeeded"]


@pytest.mark.parametrize("other", [{"problem": "q", "setting": "t"}, {"problem": "q"}])
def test_plans_of_other_problems_refute_nothing(results, claiming, other):
    runs = read_runs([results([claiming("a", cost=12, factor=1.0), claiming("b", cost=10, **other)])])
    assert runs.status == ["succeeded"] * 2


def test_a_planner_that_assigns_is_compared_with_every_assignment_of_the_scenario(results, claiming):
    assigning = claiming("assigning", cost=12, factor=1.0, assigns=True, problem="any")
    assert read_runs([results([assigning, claiming("b", cost=10)], "one")]).status[0] == "promise_broken"
    elsewhere = claiming("b", seed=1, cost=10)  # another scenario on the same roadmap
    assert read_runs([results([assigning, elsewhere], "two")]).status[0] == "succeeded"


def test_a_plan_whose_cost_is_not_known_to_be_valid_refutes_nothing(results, claiming):
    runs = read_runs([results([claiming("a", cost=12, factor=1.0), claiming("b", cost=None)])])
    assert runs.status == ["succeeded"] * 2


@pytest.mark.parametrize("plan", [{}, {"problem": "p"}, {"cost": 12, "factor": 1.0}])
def test_records_without_claims_break_no_promise(results, claiming, record, plan):
    runs = read_runs([results([record("a", plan=plan), claiming("b", cost=10)])])
    assert runs.status == ["succeeded"] * 2


@pytest.mark.parametrize("plan", [3, {"cost": "low"}, {"problem": [1]}, {"cost": 10**400}])
def test_a_line_whose_claims_have_wrong_types_is_no_record(results, claiming, record, plan):
    found = results([record("a", plan=plan), claiming("b", cost=10)])
    assert len(found) == len(found.damaged) == 1


def test_a_run_that_breaks_a_promise_counts_as_a_failure_in_every_number(results, claiming):
    records = [claiming("liar", seed, cost=12, factor=1.0, problem=f"p{seed}") for seed in range(8)]
    records += [claiming("honest", seed, cost=10, problem=f"p{seed}") for seed in range(8)]
    report = make_report([results(records)], ["planning.cost", PAR2, "timing.planning_s"])
    liar, honest = report.numbers[0]
    assert (liar.overall["succeeded"].value, liar.overall["planned"].value) == (0, 0)
    assert liar.overall["planning.cost"] is None
    assert liar.overall["timing.planning_s"] is None
    assert (liar.overall[PAR2].value, honest.overall[PAR2].value) == (20, 1)
    verdicts = {entry.column.name: entry.verdict for entry in report.comparisons}
    assert verdicts == {"succeeded": "better", PAR2: "better"}  # the honest planner, compared with the other one


def test_the_report_names_the_runs_and_what_refutes_them(results, claiming):
    records = [claiming("liar", cost=12, factor=1.0), claiming("honest", cost=10)]
    tables = {table.key: table for table in make_report([results(records)]).tables()}
    (row,) = tables["promises"].rows
    assert row[:2] == ("liar-0-0-5-", "liar")
    assert "run honest-0-0-5 has a valid plan of cost 10" in row[-1]
    assert "1 promise_broken" in tables["outcome"].rows[0]
    assert "promises" not in {table.key for table in make_report([results(records[1:], "honest")]).tables()}


@pytest.mark.parametrize("status", ["crashed", "contract_broken", "out_of_memory", "wall_timeout", "plan_timeout"])
@pytest.mark.parametrize("stage", ["planning", "execution", "replanning"])
def test_a_run_that_failed_without_a_known_time_is_penalised(results, record, status, stage):
    """A planner that leaks memory until the execution fails has no time, which must not drop the run from its mean."""
    lost = record("leaky", 1, status, timing={}, error={"stage": stage, "message": "gone"})
    runs = read_runs([results([record("leaky", 0), lost])])
    assert runs.values[PAR2].tolist() == [1, 20]
    assert runs.values["succeeded"].tolist() == [1, 0]
    assert runs.counted.all()
    assert np.isnan(runs.values["timing.planning_s"][1])
