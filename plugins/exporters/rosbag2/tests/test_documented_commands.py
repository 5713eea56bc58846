"""Every command of docs/reference/ros.md runs as it is written there."""

import importlib.util
import re
import shlex
import shutil
from pathlib import Path

import pytest

from mrpbench_core.cli.main import main
from mrpbench_core.files.scenario import read_scenario

PAGE = Path(__file__).parents[4] / "docs" / "reference" / "ros.md"
CONFIGURATION = """
name: office
world: office
roadmap: {plugin: grid, cell_size: 0.7}
scenario: {plugin: random, robots: 2}
planner: example
simulator: kinematic
limits: {execution: 20 s}
"""
ELSEWHERE = ("ros2", "pip")
"""Programs that the page names and that are not ours."""


def commands():
    """Words of each command in the shell blocks, with the variables that precede it."""
    for block in re.findall(r"```sh\n(.*?)```", PAGE.read_text(), re.DOTALL):
        for line in block.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words and words[0] not in ELSEWHERE:
                yield words


def driven(bag, say, starts):
    """Robots `husky_1`, `husky_2`, … drive half a metre from the starts of the scenario."""
    for step in range(50):
        for index, (x, y, _) in enumerate(starts):
            say(bag, f"/husky_{index + 1}", step / 10, float(x) + step / 100, float(y))
    return bag.close()


def localized(bag, robot, t, x, y):
    bag.amcl(f"{robot}/amcl_pose", t, x, y, 0.0)


def filtered(bag, robot, t, x, y):
    bag.odometry(f"{robot}/odometry/filtered", t, x, y, 0.0)


@pytest.mark.skipif(importlib.util.find_spec("rclpy") is not None, reason="`make ros` tests the live commands")
def test_every_command_of_the_page_runs_as_written(foreign, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("office.yaml").write_text(CONFIGURATION)
    assert main(["run", "office.yaml"]) == 0
    done = []
    for words in commands():
        while "=" in words[0]:
            name, _, value = words.pop(0).partition("=")
            monkeypatch.setenv(name, value)
        assert words[0] == "mrpbench", words
        if words[1] == "run":  # else the run is there already
            shutil.rmtree("results/office")
        if words[1] == "analyze":
            say = filtered if "odometry/filtered" in " ".join(words) else localized
            starts = read_scenario(Path("scenario.yaml")).start
            shutil.rmtree("foreign", ignore_errors=True)
            bag = driven(foreign(), say, starts)
            words = [word.replace("BAG", str(bag)) for word in words]
            if "…" in words:
                place = words.index("…")
                words[place : place + 1] = ["--world", "office", "--scenario", "scenario.yaml"]
        code = main(words[1:])
        said = capsys.readouterr()
        if "navigator=ros2" in words:
            assert "ROS 2 cannot be imported" in said.err
        else:
            assert code == 0, (words, said.err)
        done.append(words[1])
    assert done == ["export", "export", "scenario", "analyze", "report", "analyze", "run", "run"]
    assert Path("bag/metadata.yaml").is_file()
    assert Path("fleet/metadata.yaml").is_file()
