"""`mrpbench analyze OUTPUT.json`."""

import json

import pytest

from mrpbench_core.cli.main import main


@pytest.fixture
def files(tmp_path):
    (tmp_path / "m.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    (tmp_path / "a.agents").write_text("1\n0\n")
    (tmp_path / "t.tasks").write_text("2\n2\n0\n")
    problem = {"mapFile": "m.map", "agentFile": "a.agents", "taskFile": "t.tasks", "teamSize": 1, "numTasksReveal": 1}
    output = {"actionModel": "MAPF_T", "teamSize": 1, "makespan": 3, "numTaskFinished": 1, "start": [[0, 0, "E"]]}
    output |= {"actualPaths": ["F,F,W"], "tasks": [[0, 0, 2], [1, 0, 0]]}
    output |= {"events": [[[0, 0, "assigned"], [0, 2, "finished"], [1, 2, "assigned"]]]}
    (tmp_path / "problem.json").write_text(json.dumps(problem))

    def write(**changes):
        (tmp_path / "output.json").write_text(json.dumps(output | changes))
        return [str(tmp_path / "output.json"), "--scenario", str(tmp_path / "problem.json")]

    return write


def test_a_right_output_is_scored(files, capsys):
    assert main(["analyze", *files(), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["tasks"] == 1


def test_a_broken_rule_is_named_and_gives_the_exit_code(files, capsys):
    assert main(["analyze", *files(actualPaths=["F,F,F"])]) == 1
    assert "time 3: robot 0 leaves the map" in capsys.readouterr().out


def test_a_malformed_output_gives_one_line(files, capsys):
    assert main(["analyze", *files(actualPaths=["F,X,F"])]) == 2
    assert "output.json:1: actualPaths: robot 0 should be letters" in capsys.readouterr().err


def test_the_problem_has_to_be_named(files, capsys):
    assert main(["analyze", files()[0]]) == 2
    assert "needs --scenario PROBLEM.json" in capsys.readouterr().err
