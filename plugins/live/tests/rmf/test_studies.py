"""The studies of Open-RMF's scenarios load, both sides of each with one world and the same starts."""

from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
from mrpbench_core.api import Feature
from mrpbench_core.config.study import load_study

FOLDER = Path(__file__).parents[4] / "studies" / "rmf"


@pytest.mark.parametrize("name", ["swap", "redirect", "follow"])
def test_both_sides_of_a_scenario_have_one_world_and_one_pace(name):
    robots, traffic = (load_study(FOLDER / f"{it}.yaml") for it in (name, f"{name}_traffic"))
    assert not robots.errors
    assert not traffic.errors
    (robots,), (traffic,) = robots.runs, traffic.runs
    for key in ("world", "roadmap", "scenario", "fleet"):
        assert robots.canonical[key] == traffic.canonical[key]
    assert robots.canonical["dispatcher"]["pace"] == traffic.canonical["simulator"]["pace"]


def test_plans_of_the_patrol_do_not_take_longer_and_longer():
    (traffic,) = load_study(FOLDER / "swap_traffic.yaml").runs
    assert Feature.SINCE in traffic.config.planner.supports  # else the problem has all that the robots ever drove
