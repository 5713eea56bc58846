"""Goals that cannot be reached: the scenario's fault, or the assignment's."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.store.paths import RunPaths

ISLANDS = """
name: islands
levels:
  L1:
    measurements: [[0, 1, {distance: [3, 10.0]}]]
    vertices: [[0, 0, 0, a], [100, 0, 0, b], [0, 20, 0, c], [100, 20, 0, d]]
    lanes: [[0, 1, {bidirectional: [4, true]}], [2, 3, {bidirectional: [4, true]}]]
"""


@pytest.mark.parametrize(
    ("goals", "assigner", "status"),
    [
        # c is nearer to a than b is, but there is no way: b and d would do
        (["c", "b"], {"plugin": "hungarian", "cost": "euclidean"}, "assignment_failed"),
        (["c", "b"], {"plugin": "hungarian", "cost": "roadmap"}, "succeeded"),
        (["c", "b"], "identity", "scenario_infeasible"),
    ],
)
def test_an_unreachable_goal_is_a_fault_of_the_scenario_or_of_the_assignment(tmp_path, goals, assigner, status):
    pytest.importorskip("mrpbench_assigners_hungarian")
    (tmp_path / "islands.building.yaml").write_text(ISLANDS)
    study = {
        "world": {"plugin": "rmf", "file": str(tmp_path / "islands.building.yaml")},
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": ["a", "d"], "goals": goals},
        "assigner": assigner,
        "simulator": "none",
    }
    pytest.importorskip("mrpbench_planners_mapf")
    (point,) = load_study(study | {"planner": "astar"}).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    assert record["status"] == status
    if status == "assignment_failed":
        assert "cannot reach" in record["error"]["message"]
        assert "cost: roadmap" in record["error"]["message"]
