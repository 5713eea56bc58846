"""Distributions that are no part of this project, installed as pip would leave them."""

from pathlib import Path

from mrpbench_core import load
from mrpbench_core.store.invocation import write_document

PACKAGED = """
import attrs
from mrpbench_core.api import Planner
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus

@attrs.frozen(kw_only=True)
class GivesUp(Planner):
    def plan(self, problem, budget):
        return PlanResult(status=PlanStatus.UNSOLVABLE)
"""

WATCHER = """
import os
from mrpbench_core.api import hookimpl

@hookimpl
def mrpbench_planned(problem, result):
    print("planned for", len(problem.start), "robots:", result.status)

@hookimpl
def mrpbench_run_finished(record):
    raise RuntimeError("a watcher's own trouble")
"""


def test_a_planner_of_another_distribution_is_run_and_done_again_when_its_version_changes(study, publish, command):
    entry_points = "[mrpbench.planners]\ngives_up = acme_planner:GivesUp\n"
    write_document(Path("odd.yaml"), study | {"planner": "gives_up"})
    publish("acme-planner", entry_points, PACKAGED, version="1.0")
    first = command("run", "odd.yaml", "--out", "out")
    assert (first.returncode, first.stderr) == (0, "")
    assert "acme-planner 1.0: gives_up" in first.stdout.splitlines()[0]
    (record,) = load("out")
    assert record["provenance"]["components"][-1]["distribution"] == "acme-planner"
    publish("acme-planner", entry_points, PACKAGED, version="1.1")
    told = command("run", "odd.yaml", "--out", "out").stdout
    assert "1 recorded runs were made with other versions or sources of plugins (`--rerun changed`" in told
    command("run", "odd.yaml", "--out", "out", "--rerun", "changed")
    (record,) = load("out")
    assert record["attempt"] == 2
    assert record["provenance"]["versions"]["acme-planner"] == "1.1"


def test_hooks_watch_the_runs_process_and_one_that_raises_changes_nothing(study, publish, command):
    publish("acme-watch", "[mrpbench.hooks]\nwatch = acme_watch\n", WATCHER)
    write_document(Path("odd.yaml"), study)
    done = command("run", "odd.yaml", "--out", "out")
    assert done.returncode == 0
    assert "a watcher's own trouble" in done.stderr
    (record,) = load("out")
    assert record["status"] == "plan_unsolvable"
    assert Path("out/logs", f"{record['run_id']}.txt").read_text() == "planned for 2 robots: unsolvable\n"
