"""A site of two bundles, one of which was found to be forged; texts carry markup."""

import json

import pytest
from mrpbench_publish.files.description import Author, Description
from mrpbench_publish.site.boards import make_boards
from mrpbench_publish.site.pages import Entry, write_site

from mrpbench_core import load
from mrpbench_core.report.report import make_report

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


def record(planner, seed, more):
    """A run that succeeded, with `more` costs."""
    return {
        "run_id": f"{''.join(filter(str.isalnum, planner))}-{seed}",
        "scenario_id": f"scenario-{seed}",
        "attempt": 1,
        "config": {"planner": {"plugin": planner}, "scenario": {"plugin": "random", "robots": 5}, "seed": seed},
        "seed": seed,
        "repeat": 0,
        "status": "succeeded",
        "metrics": {"planning.solved": True, "planning.cost": 20.0 + seed + more},
        "timing": {"planning_s": 0.01 * (seed + 1) * (1 + more), "clock_bound": False},
        "provenance": {},
    }


@pytest.fixture(scope="package")
def boards(tmp_path_factory):
    """Return the boards of two planners that differ and one that does not clearly differ from the first."""
    records = [
        record(planner, seed, more)
        for planner, more in (("cbs", 0.0), ("pbs", 0.0), ("<b>bad</b>", 5.0))
        for seed in range(12)
    ]
    folder = tmp_path_factory.mktemp("bundle")
    (folder / "runs").mkdir()
    (folder / "runs/1.jsonl").write_text("".join(json.dumps(it) + "\n" for it in records))
    (folder / "invocations").mkdir()
    column = {"planning.cost": {"unit": "s", "better": "lower", "description": "what it costs", "source": ""}}
    (folder / "invocations/1.yaml").write_text(json.dumps({"columns": column}))
    return make_boards(make_report([load(folder)], ["planning.cost"]))


@pytest.fixture(scope="package")
def site(boards, tmp_path_factory):
    """Return the folder of the site."""
    folder = tmp_path_factory.mktemp("site")
    run = boards[0].rows[0].run_ids[0]
    forged = entry(2, findings=[f"2 runs of the study without a record {HOSTILE}"])
    write_site([entry(1, replays=[run]), forged], boards, "Results", folder)
    return folder
