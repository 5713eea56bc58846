"""`mrpbench init` where only the core is installed; `test_run.py` runs what it writes elsewhere."""

from mrpbench_scaffold.commands import init

from mrpbench_core.plugins.installed import providers
from mrpbench_core.plugins.kinds import GROUPS


def test_the_core_alone_says_what_to_install(mrpbench, monkeypatch, tmp_path):
    own = {group: [it for it in providers(group) if it.distribution == "mrpbench-core"] for group in GROUPS.values()}
    monkeypatch.setattr(init, "providers", own.get)
    code, out, _ = mrpbench("init", "first")
    assert code == 0
    assert out.splitlines() == [
        "planner cbs is not installed: mrpbench-standard has it: `pip install mrpbench`",
        "controller pure_pursuit is not installed: mrpbench-standard has it: `pip install mrpbench`",
        "wrote first.yaml; run it with `mrpbench run first.yaml`",
    ]
    assert "assigner: identity" in (tmp_path / "first.yaml").read_text()
