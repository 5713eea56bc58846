"""`docs/how-to/planner-external.md`, followed to the letter with stand-ins for the programs that it runs."""

import json
import os
import re
import sys
from pathlib import Path

import pytest
from mrpbench_scaffold.distribution import contents
from mrpbench_scaffold.plugin import named

pytestmark = pytest.mark.skipif("MRPBENCH_ALL_PAGES" not in os.environ, reason="`make pages` follows this page")
PAGE = (Path(__file__).parents[3] / "docs/how-to/planner-external.md").read_text()
CALLED = """\
#!{python} -IS
import os, re, runpy, sys
given = dict(zip(sys.argv[1::2], sys.argv[2::2])) if "{name}" == "lacam3" else dict(
    re.match(r"(-{{1,2}}\\w+)[ =](.*)", word).groups()
    for word in re.findall(r"-{{1,2}}\\w+[ =]\\S+", " ".join(sys.argv[1:]))
)
scen, paths = (given["-i"], given["-o"]) if "{name}" == "lacam3" else (given["-a"], given["--outputPaths"])
sys.argv[1:] = ["--map", given["-m"], "--scen", scen, "--paths", paths, "--seconds", given["-t"]]
runpy.run_path("{stand_in}", run_name="__main__")
if "{name}" == "lacam3":
    lines = open(paths).read().splitlines() if os.path.exists(paths) else []
    ways = [re.findall(r"\\((\\d+),(\\d+)\\)", line) for line in lines]
    with open(paths, "w") as file:
        file.write(f"solved={{int(bool(ways))}}\\nsolution=\\n")
        for step in range(max(map(len, ways), default=0)):
            cells = (way[min(step, len(way) - 1)] for way in ways)
            file.write(f"{{step}}:" + "".join(f"({{c}},{{r}})," for r, c in cells) + "\\n")
"""


def blocks(language):
    """The blocks of code in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.fixture
def programs(tmp_path):
    """Stand-ins for the two programs of the page, called as theirs are."""
    stand_in = tmp_path / "stand_in.py"
    stand_in.write_text(contents(named("planner", "acme", "external"))["tests/stand_in.py"])
    for name in ("eecbs", "lacam3"):
        file = tmp_path / name
        file.write_text(CALLED.format(python=sys.executable, name=name, stand_in=stand_in))
        file.chmod(0o755)


@pytest.mark.usefixtures("programs")
def test_known_programs_are_checked_and_compared_under_their_labels(environment, tmp_path):
    (tmp_path / "programs.yaml").write_text(blocks("yaml")[0])
    done = environment("sh", "-ec", blocks("sh")[0], cwd=tmp_path, timeout=500).stdout
    assert " 0 failed" in done
    shards = tmp_path.glob("results/programs/runs/*.jsonl")
    records = [json.loads(line) for file in shards for line in file.read_text().splitlines()]
    assert [record["status"] for record in records] == ["succeeded"] * 6
    tables = done.rpartition("[6/6]")[2].partition("\n")[2]
    assert re.search(r"\bEECBS\b", tables)
    assert re.search(r"\bLaCAM3\b", tables)


def test_the_folder_of_a_program_is_installed_and_checked(environment, tmp_path, monkeypatch):
    monkeypatch.setenv("PIP_NO_DEPS", "1")  # they are here, in the version of this checkout
    monkeypatch.setenv("PIP_NO_BUILD_ISOLATION", "0")  # pip reads this as: no isolation
    assert " 0 failed" in environment("sh", "-ec", blocks("sh")[1], cwd=tmp_path, timeout=500).stdout
    environment("pip", "uninstall", "--quiet", "--yes", "mrpbench-planners-acme", cwd=tmp_path)
