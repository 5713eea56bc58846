"""`mrpbench tune STUDY`."""

import json
from pathlib import Path

import pytest

from mrpbench_core.store.results import load

pytest.importorskip("optuna", reason="tuning needs Optuna")

STUDY = """\
name: room
world: {plugin: movingai, file: room.map, resolution: 0.5}
roadmap: grid
scenario: {plugin: random, robots: 1}
assigner: identity
planner: example
controller: graceful
control_rate: 5
metrics: [execution]
recording: {keep: none}
limits: {execution: 60 s}
matrix: {seed: 0..9}
"""


@pytest.fixture
def room(mrpbench):
    for needed in ("mrpbench_planners_example", "mrpbench_controllers_graceful"):
        pytest.importorskip(needed)
    Path("room.map").write_text("type octile\nheight 2\nwidth 9\nmap\n.........\n.........\n")
    Path("room.yaml").write_text(STUDY)
    return mrpbench


def test_a_tuned_controller_is_a_nav2_file_that_gives_the_same_runs(room):
    words = ("tune", "room.yaml", "--settings", "3", "--vary", "controller.v_linear_min", "--vary")
    words = (*words, "controller.slowdown_radius=0.2..1.6", "--json")
    code, output, errors = room(*words)
    assert code == 0, errors
    answer = json.loads(output)
    (tuned,) = answer["settings"]
    figures = tuned["held_out"][0]["metrics"]["execution.duration_s"]
    assert figures["standing"] == "better"
    assert figures["pairs"] == 6
    assert figures["difference"][2] < 0
    assert answer["answer"].startswith("room: execution.duration_s is ")
    assert "less" in answer["answer"]
    code, again, errors = room(*words)
    assert (code, again) == (0, output)
    assert "[1/" not in errors
    assert room("run", tuned["files"]["study"], "seed=0..2", "--out", "again")[0] == 0
    options = [f"{key}={value}" for key, value in tuned["setting"].items()]
    assert room("run", "room.yaml", *options, "seed=0..2", "--out", "options")[0] == 0
    first, second = ({record["seed"]: record["metrics"] for record in load(folder)} for folder in ("again", "options"))
    assert first == second
    assert len(first) == 3


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("seed=0..7",), "seed: 8 seeds are too few to tune"),
        (("--minimize", "execution.success"), "--minimize execution.success: higher is better"),
        (("--minimize", "execution.duration"), "the study has no such column"),
        (("--vary", "controller.k_fi"), "--vary controller.k_fi: the study has no such option"),
        (("--vary", "goal_tolerance=0.9..0.1"), "--vary goal_tolerance: the range 0.9..0.1 is empty"),
        (("--subject-to", "energy<=3"), "--subject-to energy<=3: the study has no column energy"),
        (("--held-out", "world"), "--held-out world: expected KEY=VALUE"),
        (("--held-out", "world=["), "command line: world"),
        (("--held-out", "nosuch=3"), "command line: nosuch: unknown key"),
        (("--held-out", "limits.none.such=3"), "limits.none"),
        (("--held-out", "seed=3"), "--held-out seed=3: the held-out seeds are those of the study"),
        (("--held-out", "controller=rpp"), "--held-out controller=rpp: the search varies controller."),
        (("--minimize", "execution.duration_s", "--maximize", "execution.duration_s"), "named twice"),
        (("planner=[example, cbs]",), "the study has 2 configurations"),
    ],
)
def test_mistakes_are_one_line(room, words, message):
    code, _, errors = room("tune", "room.yaml", *words)
    assert code == 2
    assert message in errors
    assert len(errors.splitlines()) == 1
