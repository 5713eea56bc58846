"""`mrpbench league-score`."""

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
        return [str(tmp_path / "problem.json"), str(tmp_path / "output.json")]

    return write


def test_a_right_output_is_scored(files, capsys):
    assert main(["league-score", *files(), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["tasks"] == 1


def test_a_broken_rule_is_named_and_gives_the_exit_code(files, capsys):
    assert main(["league-score", *files(actualPaths=["F,F,F"])]) == 1
    assert "time 3: robot 0 leaves the map" in capsys.readouterr().out


def test_a_malformed_output_gives_one_line(files, capsys):
    assert main(["league-score", *files(actualPaths=["F,X,F"])]) == 2
    assert "output.json:1: actualPaths: robot 0 should be letters" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"actualPaths": [""]}, "actualPaths: robot 0 has 0 steps, which is not the makespan 3\n"),
        ({"actualPaths": ["F"]}, "actualPaths: robot 0 has 1 step, which is not the makespan 3\n"),
        ({"makespan": 0}, "actualPaths: robot 0 has 3 steps, which is not the makespan 0\n"),
    ],
)
def test_motion_of_another_length_is_named(files, capsys, changes, message):
    assert main(["league-score", *files(**changes)]) == 1
    assert message in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[" * 100_000, "is not JSON: nested too deeply"),
        (
            '{"teamSize": ' + "9" * 5000 + "}",
            "is not JSON: Exceeds the limit (4300 digits) for integer string conversion",
        ),
        ('{"teamSize": [' + "1," * 5000 + "1]}", "teamSize: should be a whole number from 1 to 2147483647, is [1, 1"),
        ('{"teamSize": 1, "makespan": 3}', "has no 'actualPaths'"),
    ],
)
def test_any_text_gives_one_short_line(files, tmp_path, capsys, text, message):
    words = files()
    (tmp_path / "output.json").write_text(text)
    assert main(["league-score", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line
    assert len(line) < 400


def test_paths_that_would_fill_the_memory_are_refused(files, monkeypatch, capsys):
    monkeypatch.setattr("mrpbench_league.files.output.MOST", 2)
    assert main(["league-score", *files()]) == 2
    assert "actualPaths: more than 2 actions, if all robots had as many as the longest path" in capsys.readouterr().err
