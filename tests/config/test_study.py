"""From a file to runs."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors

SMALL = "world: office\nscenario: {robots: 5}\nplanner: ecbs\n"


@pytest.fixture
def study(toy, tmp_path):
    """Return a function that loads a text as a configuration."""

    def load(text, *overrides):
        path = tmp_path / "some.yaml"
        path.write_text(text)
        return load_study(path, overrides)

    return load


@pytest.fixture
def errors(study, tmp_path):
    """Return a function that gives the lines of the errors of a text."""

    def load(text, *overrides):
        with pytest.raises(InputErrors) as caught:
            study(text, *overrides)
        return str(caught.value).replace(f"{tmp_path}/", "").splitlines()

    return load


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
