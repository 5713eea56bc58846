"""Worker slots of several studies in one process."""

from pathlib import Path

from mrpbench_core import run
from mrpbench_core.engine.processes.slots import slots_of_this_process


def test_nested_contexts_share_their_slots_until_the_outermost_ends():
    with slots_of_this_process() as outer:
        with slots_of_this_process() as inner:
            assert inner == outer
        with slots_of_this_process() as again:
            assert again == outer
    with slots_of_this_process() as later:
        assert later != outer


def test_studies_within_one_context_have_the_same_workers(study):
    study["planner"]["does"] = "leave_name_of_supervisor"
    source = Path("odd.py")
    source.write_text(
        source.read_text()
        + "\n    def _leave_name_of_supervisor(self):\n"
        + "        import psutil\n"
        + "        Path(self.marks, str(psutil.Process().parents()[1].pid)).touch()\n"
    )
    with slots_of_this_process():
        for seed in range(2):
            run(study | {"seed": seed}, out="out")
    assert len(list(Path("marks").iterdir())) == 1


def test_a_plugin_that_stops_the_supervisor_costs_its_own_run_only(study, monkeypatch):
    monkeypatch.setattr("mrpbench_core.engine.processes.slot.LATE_S", 0.0)
    monkeypatch.setattr("mrpbench_core.engine.processes.child.ENDING_S", 0.2)
    study["limits"]["wall"] = 5.0
    source = Path("odd.py")
    source.write_text(
        source.read_text()
        + "\n    def _stop_the_supervisor(self):\n"
        + "        import psutil\n"
        + "        psutil.Process().parents()[1].suspend()\n"
    )
    results = run(study | {"matrix": {"planner.does": ["stop_the_supervisor", "nothing"]}}, out="out")
    records = {record["config"]["planner"]["does"]: record for record in results}
    assert records["stop_the_supervisor"]["status"] == "crashed"
    assert "did not end the run at its wall limit" in records["stop_the_supervisor"]["error"]["message"]
    assert records["nothing"]["status"] == "plan_unsolvable"
