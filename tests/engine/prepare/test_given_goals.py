"""Goals that a scenario file gives to robots stay with them, or the record says so."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

MAP = "type octile\nheight 2\nwidth 4\nmap\n....\n....\n"
ROWS = ["0\topen.map\t4\t2\t0\t0\t3\t0\t3", "0\topen.map\t4\t2\t3\t1\t0\t1\t3"]
"""Each robot starts next to the goal of the other."""


@pytest.fixture
def point(tmp_path):
    (tmp_path / "open.map").write_text(MAP)
    (tmp_path / "open.scen").write_text("\n".join(["version 1", *ROWS]) + "\n")

    def load(scenario=None, **changes):
        study = {
            "world": {"plugin": "movingai", "file": str(tmp_path / "open.map")},
            "roadmap": "grid",
            "scenario": scenario or {"plugin": "movingai", "file": str(tmp_path / "open.scen"), "robots": 2},
            "planner": "example",
            "simulator": "none",
            "metrics": ["planning"],
            **changes,
        }
        return load_study(study).runs[0]

    return load


def record_of(point, tmp_path):
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None).message()


def test_robots_keep_the_goals_of_the_file(point, tmp_path):
    default = point()
    assert default.canonical["assigner"]["plugin"] == "identity"
    record = record_of(default, tmp_path)
    assert record["reassigned"] == 0
    assert record["metrics"]["planning.sum_of_costs_ticks"] == 6


def test_an_assigner_that_changes_goals_is_recorded(point, tmp_path):
    record = record_of(point(assigner="hungarian"), tmp_path)
    assert record["reassigned"] == 2
    assert record["metrics"]["planning.sum_of_costs_ticks"] == 2


def test_run_ids_with_a_named_assigner_are_stable(point):
    assert point().run_id == point(assigner="identity").run_id != point(assigner="hungarian").run_id
    drawn = {"plugin": "random", "robots": 2}
    assert point(drawn).run_id == point(drawn, assigner="hungarian").run_id != point(drawn, assigner="identity").run_id
