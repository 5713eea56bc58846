"""The identity of runs."""

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mrpbench_core.config.study import load_study

BASE = {"world": "office", "scenario": {"robots": 5}, "planner": "ecbs"}

EXPLICIT = {
    "name": "other",
    "roadmap": {"plugin": "lanes", "cell_size": "40 cm"},
    "fleet": [{"robot": "turtlebot3_burger", "lidar": None}],
    "assigner": {"objective": "sum", "plugin": "hungarian", "cost": "euclidean"},
    "planner": {"heuristic": "cg", "plugin": "ecbs", "w": 1.2, "weights": [1, 2]},
    "dispatcher": "adg",
    "navigator": {"plugin": "waypoints"},
    "controller": "pure_pursuit",
    "simulator": {"timestep": "1/240"},
    "localizer": "ground_truth",
    "noise": {"lidar": 0},
    "metrics": ["execution"],
    "export": ["rosbag2"],
    "recording": {"scans": True},
    "limits": {"planning": "1 min", "memory": "4 GiB", "wall": "1 h"},
    "replanning": {"latency": "0 s"},
    "seed": 0,
    "repeat": 0,
}
DIFFERENT = {
    "world": {"plugin": "rmf", "file": "map.yaml"},
    "roadmap": {"cell_size": 0.5},
    "scenario": {"robots": 6},
    "fleet": "turtlebot3_waffle",
    "assigner": {"objective": "bottleneck"},
    "planner": {"plugin": "ecbs", "w": 1.3},
    "controller": "dwb",
    "simulator": "none",
    "noise": {"lidar": 0.01},
    "limits": {"planning": 61},
    "replanning": {"latency": 1},
    "seed": 1,
    "repeat": 1,
}


def run(text_or_data, folder=None):
    (found,) = load_study(text_or_data).runs
    return found


@pytest.fixture(autouse=True)
def folder(toy, tmp_path, monkeypatch):
    (tmp_path / "map.yaml").write_text("walls")
    monkeypatch.chdir(tmp_path)


def test_an_id_is_sixteen_hexadecimal_digits_and_does_not_change_between_versions():
    # A changed value here means that every result on disk is looked for in vain: do not change it lightly.
    assert run(BASE).run_id == run(dict(reversed(BASE.items()))).run_id == "5b0a7243401496fd"


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sets(st.sampled_from(sorted(EXPLICIT))), st.randoms())
def test_writing_a_default_or_another_order_changes_nothing(keys, random):
    data = list((BASE | {key: EXPLICIT[key] for key in keys}).items())
    random.shuffle(data)
    assert run(dict(data)).run_id == run(BASE).run_id


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sets(st.sampled_from(sorted(DIFFERENT))), st.sets(st.sampled_from(sorted(DIFFERENT))))
def test_every_other_choice_is_another_run(one, other):
    def identity(keys):
        return run(BASE | {key: DIFFERENT[key] for key in keys}).run_id

    def effective(keys):
        return keys - {"noise", "replanning"} if "simulator" in keys else keys  # without one nothing is executed

    assert (identity(one) == identity(other)) == (effective(one) == effective(other))


def test_a_file_counts_by_content(tmp_path):
    data = BASE | {"world": {"plugin": "rmf", "file": "map.yaml"}}
    before = run(data)
    (tmp_path / "moved").mkdir()
    (tmp_path / "moved" / "other.yaml").write_text("walls")
    moved = run(BASE | {"world": {"plugin": "rmf", "file": "moved/other.yaml"}})
    assert moved.run_id == before.run_id
    assert moved.canonical != before.canonical
    (tmp_path / "map.yaml").write_text("other walls")
    changed = run(data)
    assert changed.run_id != before.run_id


def test_where_the_configuration_lies_does_not_count(tmp_path):
    data = BASE | {"world": {"plugin": "rmf", "file": "map.yaml"}, "planner": "./mine.py:Mine"}
    code = (
        "import attrs\nfrom mrpbench_core.api import Planner\n@attrs.frozen(kw_only=True)\nclass Mine(Planner):\n    "
    )
    ids = set()
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "map.yaml").write_text("walls")
        (tmp_path / name / "mine.py").write_text(f"{code}def plan(self, problem, budget): return '{name}'\n")
        (tmp_path / name / "run.yaml").write_text(yaml.safe_dump(data))
        ids.add(run(tmp_path / name / "run.yaml").run_id)
    assert len(ids) == 1


def test_a_planner_that_assigns_makes_the_assigner_irrelevant():
    def identity(planner, objective):
        return run(BASE | {"planner": planner, "assigner": {"objective": objective}}).run_id

    assigning = {"plugin": "task_assigning", "assign": True}
    assert identity(assigning, "sum") == identity(assigning, "bottleneck")
    assert identity("task_assigning", "sum") != identity("task_assigning", "bottleneck")


def test_options_of_the_execution_may_be_left_out_without_one():
    planning = BASE | {"simulator": "none"}
    assert run(planning).run_id == run(planning | {"controller": "pure_pursuit", "dispatcher": "none"}).run_id
    assert run(planning).run_id != run(planning | {"controller": "dwb"}).run_id
    noisy = planning | {"noise": {"lidar": 0.1}, "limits": {"execution": 9}, "replanning": {"delay": 5}}
    assert run(planning).run_id == run(noisy).run_id


def test_the_same_work_may_be_measured_and_named_otherwise():
    one = run(BASE).run_id
    assert one == run(BASE | {"name": "x", "metrics": [], "limits": {"wall": 9}}).run_id
    assert one != run(BASE | {"limits": {"planning": 9}}).run_id
