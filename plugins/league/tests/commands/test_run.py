"""`mrpbench league-run`."""

import json
import sys

import pytest
from mrpbench_league.commands.run import main as mrpbench_league
from mrpbench_league.files.output import read_output
from mrpbench_league.files.problem import read_problem
from mrpbench_league.scoring.rescore import rescore

from mrpbench_core.cli.main import main

MAP = "type octile\nheight 4\nwidth 6\nmap\n......\n.@@.@.\n.@@.@.\n......\n"


@pytest.fixture(params=[2023, 2024, 2026])
def problem(request, tmp_path):
    (tmp_path / "ring.map").write_text(MAP)
    (tmp_path / "ring.agents").write_text("4\n0\n5\n18\n23\n")
    lines = ("3", "22", "12", "5", "9", "20") if request.param == 2023 else ("3,20", "22,1", "12", "5,18,9", "23,0")
    (tmp_path / "ring.tasks").write_text("\n".join((str(len(lines)), *lines)))
    head = {"version": f"{request.param} LoRR", "mapFile": "ring.map", "agentFile": "ring.agents", "teamSize": 4}
    file = tmp_path / "ring.json"
    file.write_text(json.dumps(head | {"taskFile": "ring.tasks", "numTasksReveal": 2, "agentCounter": 3}))
    return file


def test_the_output_is_read_and_scored(problem, capsys):
    file = problem.with_name("output.json")
    assert main(["league-run", str(problem), "--duration", "210", "--out", str(file), "--iterations", "3"]) == 0
    assert "late answers" in capsys.readouterr().out
    score = rescore(read_problem(problem), read_output(file))
    assert score.faults.kept == []
    assert score.tasks > 10


def test_the_program_of_an_own_name_does_the_same(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["mrpbench-league", str(tmp_path / "none.json"), "--duration", "5"])
    assert mrpbench_league() == 2
    assert capsys.readouterr().err == f"{tmp_path}/none.json: no such file\n"


@pytest.mark.parametrize("option", ["--seed=-1", "--duration=0", "--limit=0", "--active=0"])
def test_an_option_out_of_range_gives_one_line(problem, capsys, option):
    words = ["league-run", str(problem), "--duration=5", option]
    try:
        code = main(words)
    except SystemExit as ended:
        code = ended.code
    assert code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert option.partition("=")[0].removeprefix("--") in line
