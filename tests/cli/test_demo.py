"""`mrpbench demo` from beginning to end, and what can be done with its results."""

import json
from pathlib import Path

from mrpbench_core.cli import demo
from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import GROUPS


def test_the_whole_stack_runs_and_leaves_something_to_see(mrpbench, monkeypatch):
    monkeypatch.setitem(demo.WANTED, "simulator", ("holodeck", "kinematic"))
    code, output, errors = mrpbench("demo")
    assert (code, errors) == (0, "")
    assert "simulator holodeck is not available here (not installed); the demo uses kinematic" in output
    (shard,) = Path("results/demo/runs").iterdir()
    record = json.loads(shard.read_text())
    assert record["status"] == "succeeded"
    assert record["metrics"]["execution.goals_reached"] == 5
    assert record["metrics"]["execution.robot_contacts"] == 0
    lines = dict(line.split(maxsplit=1) for line in output.splitlines()[-5:])
    assert Path(lines["picture"]).read_bytes().startswith(b"\x89PNG")
    assert any(Path(lines["bag"]).glob("*.mcap"))
    assert Path(lines["recording"]).is_file()
    assert "<canvas" in Path(lines["replay"]).read_text()

    code, output, errors = mrpbench("export", f"results/demo:{record['run_id'][:4]}", "--to", "rosbag2", "--out", "bag")
    assert (code, output, errors) == (0, "wrote bag\n", "")
    assert any(Path("bag").glob("*.mcap"))
    code, _, errors = mrpbench("export", "results/demo:zz", "--to", "rosbag2")
    assert code == 2
    assert errors.startswith("results/demo:zz: no runs begin with 'zz'")


def test_the_core_alone_says_what_to_install(mrpbench, monkeypatch):
    own = {group: [it for it in providers(group) if it.distribution == "mrpbench-core"] for group in GROUPS.values()}
    monkeypatch.setattr(demo, "providers", own.get)
    code, _, errors = mrpbench("demo")
    assert code == 2
    assert errors.endswith(
        "the demo needs a planner, and none of cbs, prioritized, example is installed"
        " (mrpbench-standard has it: `pip install mrpbench`)\n"
    )
