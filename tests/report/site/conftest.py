"""A site of two bundles, one of which was found to be forged; texts carry markup."""

import pytest

from mrpbench_core.report.report import make_report
from mrpbench_core.report.site.boards import make_boards
from mrpbench_core.report.site.pages import Entry, write_site
from mrpbench_core.store.bundle.description import Author, Description

HOSTILE = "<script>alert(1)</script>"


def entry(number, *, findings=(), replays=()):
    checks = [
        {"name": "study", "outcome": "failed" if findings else "passed", "covered": "all", "findings": list(findings)},
        {"name": "repetition", "outcome": "passed", "covered": f"drawn {HOSTILE}", "findings": []},
    ]
    return Entry(
        file=f"{number}-abcdef.zip",
        sha256=f"{number}" * 64,
        description=Description(
            title=f"Study {number} {HOSTILE}",
            text=f"What it is {HOSTILE}",
            authors=(Author(name=f"Ada {HOSTILE}"),),
            license="CC-BY-4.0",
            published="2026-11-22",
        ),
        verdict={"passed": not findings, "checks": checks, "version": "0.2", "seed": "7"},
        runs=24,
        replays={run: f"replays/{run}.html" for run in replays},
    )


@pytest.fixture(scope="package")
def boards(written, record, tmp_path_factory):
    """Return the boards of two planners that differ and one that does not clearly differ from the first."""
    records = [
        record(planner, seed, "succeeded", cost=20.0 + seed + more, took=0.01 * (seed + 1) * (1 + more))
        for planner, more in (("cbs", 0.0), ("pbs", 0.0), ("<b>bad</b>", 5.0))
        for seed in range(12)
    ]
    results = written(records, tmp_path_factory.mktemp("bundle"))
    return make_boards(make_report([results], ["planning.cost"]))


@pytest.fixture(scope="package")
def site(boards, tmp_path_factory):
    """Return the folder of the site."""
    folder = tmp_path_factory.mktemp("site")
    run = boards[0].rows[0].run_ids[0]
    forged = entry(2, findings=[f"2 runs of the study without a record {HOSTILE}"])
    write_site([entry(1, replays=[run]), forged], boards, "Results", folder)
    return folder
