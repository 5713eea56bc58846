"""A study with two planners, failures and repeats, as a page."""

import pytest

from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.report import make_report


@pytest.fixture(scope="package")
def study(written, record, tmp_path_factory):
    """Return results of two planners on ten scenarios, one of them worse and with failures that carry markup."""
    records = []
    for planner, more in (("cbs", 0.0), ("<b>bad</b>", 1.0)):
        for seed in range(10):
            for repeat in (0, 1):
                failed = more and seed == 3
                status = "plan_timeout" if failed else "succeeded"
                extra = {"error": {"stage": "planning", "message": "</script><b>no plan"}} if failed else {}
                cost = None if failed else 20.0 + seed + more * (1 + seed / 10)
                took = 0.01 * (seed + 1) * (1 + more)
                records.append(record(planner, seed, status, repeat=repeat, cost=cost, took=took, **extra))
    records.append(record("cbs", 77, "scenario_infeasible", scenario="none"))
    records.append(record("cbs", 79, "unknown", scenario="cut short", cost=5.0))
    return written(records, tmp_path_factory.mktemp("study"))


@pytest.fixture(scope="package")
def page(study, tmp_path_factory):
    """Return the page's file."""
    file = tmp_path_factory.mktemp("page") / "report.html"
    report = make_report([study], ["planning.cost", "timing.planning_s", "timing.planning_par2_s"])
    write_report(report, file, {"cbs-0-0-5-": "results/replay-cbs.html"})
    return file
