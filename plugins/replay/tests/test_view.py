import json

import pytest

from mrpbench_core import run

DRIVEN = """\
name: driven
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
planner: {plugin: prioritized, restarts: 7}
simulator: kinematic
metrics: [execution]
recording: {scans: true}
limits: {execution: 60}
"""


@pytest.fixture(scope="module")
def driven(tmp_path_factory, tiny_map):
    """Return the results of a run with a recording."""
    folder = tmp_path_factory.mktemp("driven")
    (folder / "tiny.map").write_text(tiny_map)
    (folder / "driven.yaml").write_text(DRIVEN)
    run(folder / "driven.yaml", out=folder / "results")
    return folder / "results"


def test_a_run_becomes_a_page_next_to_its_results(mrpbench, driven):
    code, output, _ = mrpbench("view", driven)
    assert code == 0
    (page,) = driven.glob("replay-*.html")
    assert output.strip() == f"wrote {page}"
    text = page.read_text(encoding="utf-8")
    run = json.loads(text.split('id="run">')[1].split("</script>")[0])
    metrics = {metric["name"]: metric for metric in run["facts"]["metrics"]}
    assert run["facts"]["status"] == "succeeded"
    assert run["facts"]["planner"] == "prioritized restarts=7", "defaults go without saying"
    assert metrics["execution.duration_s"]["unit"] == "s", "units come from the invocation"
    assert 'id="scans"' in text


def test_pictures_are_written_where_asked(mrpbench, driven, tmp_path):
    pytest.importorskip("matplotlib")
    code, _, errors = mrpbench("view", driven, "--out", "a.html", "--png", "a.png", "--gif", "a.gif")
    assert code == 0, errors
    assert (tmp_path / "a.html").read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"
    assert (tmp_path / "a.gif").read_bytes()[:6] == b"GIF89a"


def test_a_run_without_recording_says_so(mrpbench):
    mrpbench("run", "tiny.yaml", "seed=0")
    code, _, errors = mrpbench("view", "results/tiny")
    assert code == 2
    assert "the recording holds no poses (a run that ended before its execution cannot be shown)" in errors
    assert len(errors.splitlines()) == 1


def test_which_run_is_asked_for_must_be_clear(mrpbench):
    mrpbench("run", "tiny.yaml")
    code, _, errors = mrpbench("view", "results/tiny")
    assert code == 2
    assert "2 runs" in errors


def test_two_runs_become_one_page(mrpbench, driven, tmp_path):
    code, output, _ = mrpbench("view", driven, driven, "--out", tmp_path / "pair.html")
    assert code == 0
    assert output.strip() == f"wrote {tmp_path / 'pair.html'}"
    assert (tmp_path / "pair.html").read_text(encoding="utf-8").count("<iframe ") == 2


def test_a_picture_of_two_runs_is_refused(mrpbench, driven, tmp_path):
    code, _, error = mrpbench("view", driven, driven, "--png", tmp_path / "a.png")
    assert code != 0
    assert "show one run" in error
