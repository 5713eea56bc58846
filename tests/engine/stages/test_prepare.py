"""Instances of runs: what runs that agree share, and what they do not."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.stages.prepare import build_run_instance

STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "example", "simulator": "none"}
STUDY |= {"roadmap": {"plugin": "grid", "cell_size": 1.0}}


def roadmaps(name, values):
    """The roadmaps of two runs that differ in one setting."""
    one, other = load_study(STUDY | {"matrix": {name: values}}).runs
    return [build_run_instance(point.config, lambda stage, facts: None).roadmap for point in (one, other)]


def test_runs_in_the_same_world_with_the_same_robots_share_a_roadmap():
    one, other = roadmaps("seed", [0, 1])
    assert one is other


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("roadmap.cell_size", [1.0, 1.5]),
        ("fleet", ["turtlebot3_burger", "turtlebot3_waffle"]),
        ("world", ["office", "warehouse"]),
    ],
)
def test_a_roadmap_follows_its_options_the_robots_and_the_world(name, values):
    one, other = roadmaps(name, values)
    again = roadmaps(name, values[::-1])
    for built, rebuilt in ((one, again[1]), (other, again[0])):
        assert (built.position == rebuilt.position).all()
        assert (built.duration == rebuilt.duration).all()
    assert one.position.shape != other.position.shape or (one.duration != other.duration).any()
