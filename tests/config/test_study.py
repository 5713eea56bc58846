"""From a file to runs."""

import pytest

from mrpbench_core.config.study import load_studies, load_study
from mrpbench_core.files.errors import InputErrors

SMALL = "world: office\nscenario: {robots: 5}\nplanner: ecbs\n"


def test_a_world_a_fleet_size_and_a_planner_make_a_run(study):
    (run,) = study(SMALL).runs
    assert run.config.name == "some"
    assert run.config.scenario.robots == 5
    assert type(run.config.controller).__name__ == "Pursuit"
    assert list(run.config.metrics) == ["planning", "execution"]


def test_every_mistake_is_reported_at_once_in_reading_order(errors):
    text = """\
wrold: office
scenario: {robots: 0, robot: 2}
planner: ecb
noise: {lidar: -1 m, odometry: x}
limits: {planning: 5 m, memory: 4 GiB}
fleet: {robot: turtlebot3_burgr}
metrics: planing
"""
    assert [line.partition(" (")[0] for line in errors(text)] == [
        "some.yaml:1:1: wrold: unknown key",
        "some.yaml:1:1: world: is missing",
        "some.yaml:2:20: scenario.robots: 'robots' must be >= 1: 0",
        "some.yaml:2:23: scenario.robot: unknown option of 'random'",
        "some.yaml:3:10: planner: no planner is called 'ecb'",
        "some.yaml:4:16: noise.lidar: 'lidar' must be >= 0: -1.0",
        "some.yaml:4:32: noise.odometry: expected a number, got 'x'",
        "some.yaml:5:20: limits.planning: unknown unit 'm' for a quantity in s",
        "some.yaml:6:16: fleet.robot: no robot is named 'turtlebot3_burgr'",
        "some.yaml:7:10: metrics: no metric is called 'planing'",
    ]
    hints = "".join(errors(text))
    for word in ("world", "robots", "ecbs", "turtlebot3_burger", "planning"):
        assert f"did you mean {word!r}?" in hints


def test_points_that_cannot_run_are_listed_with_those_that_can(study):
    found = study(SMALL + "matrix:\n  planner: [astar, ecbs, ecsb]\n  planner.w: [1.0, 1.5]\n  seed: 0..2\n")
    assert len(found.runs) == 6
    assert found.invalid == 12
    messages = [str(error) for error in found.errors]
    assert "some.yaml:5:26: planner: no planner is called 'ecsb' (did you mean 'ecbs'?" in messages[0]
    assert "in planner=ecsb, planner.w=1.0, seed=0; " in messages[0]
    assert messages[0].endswith(" and 1 more)")
    assert "some.yaml:6:3: planner.w: unknown option of 'astar'" in messages[1]
    assert len(messages) == 2


def test_equal_runs_are_one(study):
    found = study(SMALL + "matrix:\n  planner: [ecbs, {plugin: ecbs, w: 1.2}, ecbs]\n")
    assert len(found.runs) == 1


def test_a_dict_is_a_configuration(toy):
    found = load_study({"world": "office", "scenario": {"robots": 2}, "planner": "astar", "matrix": {"seed": [1, 2]}})
    assert [run.config.seed for run in found.runs] == [1, 2]
    assert found.name == "study"
    assert found.file is None
    with pytest.raises(InputErrors, match=r"^planner: no planner is called 'x'"):
        load_study({"world": "office", "scenario": {"robots": 2}, "planner": "x"})


def test_the_mistakes_of_several_files_are_reported_together(toy, tmp_path):
    for name, text in (("a", SMALL), ("b", SMALL + "x: 1"), ("c", "[")):
        (tmp_path / f"{name}.yaml").write_text(text)
    (study,) = load_studies([tmp_path / "a.yaml"])
    assert study.name == "a"
    with pytest.raises(InputErrors) as caught:
        load_studies([tmp_path / f"{name}.yaml" for name in "abcd"])
    lines = str(caught.value).replace(f"{tmp_path}/", "").splitlines()
    assert [line.partition(":")[0] for line in lines] == ["b.yaml", "c.yaml", "d.yaml"]


@pytest.mark.parametrize("text", ["[]", "3", "planner", "null"])
def test_a_value_that_is_not_a_block_is_refused(errors, text):
    (line,) = errors(text)
    assert line.startswith("some.yaml:1:1: expected a block of settings")


def test_a_thousand_runs_are_put_together(study):
    found = study(SMALL + "matrix: {planner: [astar, ecbs], seed: 0..499}")
    assert len(found.runs) == 1000
