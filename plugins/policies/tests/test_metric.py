"""How often the shield acted, as studies show it."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

BLIND = """\
class Policy:
    def __init__(self, robots, seed):
        pass

    def act(self, observations):
        return [1] * len(observations["observation"])
"""


@pytest.fixture
def measured(tmp_path):
    """Return a function that returns the metrics of a planner, with two robots on a map of six cells."""
    (tmp_path / "blind.py").write_text(BLIND)
    (tmp_path / "maps.yaml").write_text("aisle: |-\n  ...\n  ...\n")
    (tmp_path / "list.yaml").write_text(
        "scenarios:\n  first: {map_name: aisle, seed: 0, agents_xy: [[1, 0], [1, 2]], targets_xy: [[1, 1], [0, 2]]}\n"
    )

    def run(planner):
        study = {
            "name": "shield",
            "world": {"plugin": "pogema", "file": str(tmp_path / "maps.yaml"), "map": "aisle"},
            "roadmap": "grid",
            "scenario": {"plugin": "pogema", "file": str(tmp_path / "list.yaml"), "robots": 2},
            "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
            "planner": planner,
            "simulator": "none",
            "metrics": ["policy"],
        }
        paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
        metrics = execute(load_study(study).runs[0].config, "run", paths).metrics
        return {name.removeprefix("policy."): value for name, value in metrics.items()}

    return run


def test_replaced_actions_are_counted_also_without_a_plan(measured, tmp_path):
    blind = {"plugin": "policy", "file": str(tmp_path / "blind.py"), "steps": 4}
    assert measured(blind) == {  # both move once, and then into the wall
        "shield_share": 6 / 8,
        "shield_interventions": 6,
        "illegal_actions": 6,
        "conflicting_actions": 0,
    }


def test_other_planners_have_no_shield(measured):
    assert set(measured("pibt").values()) == {None}
