"""A short subset of `make worlds`: robots driven on built-in worlds arrive and touch nothing."""

import argparse
import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[4] / "benchmarks" / "worlds.py"


@pytest.mark.parametrize("world", ["household_graph", "bottlenecks_door"])
def test_robots_arrive_and_touch_nothing(world):
    pytest.importorskip("mrpbench_planners_mapf")
    if not SCRIPT.exists():
        pytest.skip("not in a checkout")
    spec = importlib.util.spec_from_file_location("worlds", SCRIPT)
    worlds = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(worlds)
    options = argparse.Namespace(
        seeds=1, robots=5, planner="prioritized", controller="pure_pursuit", simulator="planar"
    )
    assert worlds.drive(world, options)
