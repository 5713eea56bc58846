"""`mrpbench demo` from beginning to end, and what can be done with its results."""

import json
from pathlib import Path

import attrs
from mrpbench_scaffold.commands import demo

from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import GROUPS


def test_the_whole_stack_answers_a_question_and_leaves_something_to_see(mrpbench, monkeypatch):
    monkeypatch.setitem(demo.WANTED, "simulator", ("holodeck", "planar"))
    monkeypatch.setattr(demo, "ROBOTS", 5)
    monkeypatch.setattr(demo, "SEEDS", 1)
    code, output, errors = mrpbench("demo")
    assert (code, errors) == (0, "")
    assert "simulator holodeck is not available here (not installed); the demo uses planar" in output
    records = [
        json.loads(line) for shard in Path("results/demo/runs").iterdir() for line in shard.read_text().splitlines()
    ]
    assert sorted(it["config"]["planner"]["plugin"] for it in records) == ["astar", "cbs", "eecbs"]
    assert demo.answer(records) in output
    lines = dict(line.split(maxsplit=1) for line in output.splitlines()[-6:])
    assert Path(lines["picture"]).read_bytes().startswith(b"\x89PNG")
    assert any(Path(lines["bag"]).glob("*.mcap"))
    assert Path(lines["recording"]).is_file()
    assert "<canvas" in Path(lines["replay"]).read_text()
    (record,) = (it for it in records if it["run_id"] in lines["recording"])

    code, output, errors = mrpbench("export", f"results/demo:{record['run_id'][:4]}", "--to", "rosbag2", "--out", "bag")
    assert (code, output, errors) == (0, "wrote bag\n", "")
    assert any(Path("bag").glob("*.mcap"))
    code, _, errors = mrpbench("export", "results/demo:zz", "--to", "rosbag2")
    assert code == 2
    assert errors.startswith("results/demo:zz: no runs begin with 'zz'")


def test_planners_of_other_projects_are_compared(monkeypatch):
    assert demo.others() == []
    installed = providers("mrpbench.planners")
    acme = attrs.evolve(installed[0], name="acme", distribution="acme-planner")
    monkeypatch.setattr(demo, "providers", lambda group: (*installed, acme))
    assert demo.others() == ["acme"]


def test_the_core_alone_says_what_to_install(mrpbench, monkeypatch):
    own = {group: [it for it in providers(group) if it.distribution == "mrpbench-core"] for group in GROUPS.values()}
    monkeypatch.setattr(demo, "providers", own.get)
    code, _, errors = mrpbench("demo")
    assert code == 2
    assert errors.endswith(
        "the demo needs a planner, and none of cbs, prioritized, example is installed"
        " (mrpbench-standard has it: `pip install mrpbench`)\n"
    )


def test_the_answer_counts_the_runs_of_each_planner_that_arrive():
    records = [
        {"config": {"planner": {"plugin": name}}, "status": status}
        for name in ("astar", "cbs", "eecbs")
        for status in ("succeeded", "timeout" if name == "astar" else "succeeded")
    ]
    answer = demo.answer(records)
    assert "with astar all robots arrive in 1 of 2 runs, with cbs and eecbs all robots arrive in all 2 runs." in answer
