"""`publish` and `verify` on the command line."""

import json
from pathlib import Path

import pytest


@pytest.fixture
def published(mrpbench):
    assert mrpbench("run", "tiny.yaml")[0] == 0
    code, output, errors = mrpbench("publish", "results/tiny", "--out", "tiny.zip", "--author", "Ada Lovelace")
    assert (code, errors) == (0, "")
    assert "wrote tiny.zip: 2 runs, 2 recordings" in output
    return output


def test_a_bundle_is_verified_with_a_line_for_each_check(mrpbench, published):
    code, output, _ = mrpbench("verify", "tiny.zip", "--rerun", "all", "--seed", "7", "--out", "tiny.verdict.json")
    assert code == 0
    assert "repetition   passed       2 runs of 2, drawn by the seed 7, equal outside timing" in output
    assert output.endswith("tiny.zip: nothing was found\n")
    verdict = json.loads(Path("tiny.verdict.json").read_text())
    assert verdict["passed"]
    assert f"SHA-256: {verdict['sha256']}" in published


def test_findings_give_exit_code_1(mrpbench, published, tmp_path):
    with (tmp_path / "tiny.zip").open("ab") as file:
        file.truncate(1000)
    code, output, _ = mrpbench("verify", "tiny.zip", "--json")
    assert code == 1
    (check,) = json.loads(output)["checks"]
    assert (check["name"], check["outcome"]) == ("archive", "failed")


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["verify", "none.zip"], "none.zip: no such file"),
        (["verify", "."], ".: is not a file; a bundle is a zip file"),
        (["verify", "x.zip", "--seed", "1"], "--seed draws the runs to repeat (add --rerun SHARE)"),
        (["verify", "x.zip", "--rerun", "110%"], "--rerun 110%: expected `all`, `none` or a share such as 10%"),
        (["publish", "none", "--out", "x.zip"], "none: is not a results folder"),
        (["publish", ".", "--out", "x.zip", "--recordings", "some"], "--recordings some: expected"),
        (["publish", ".", "--out", "x.zip", "--license", "my own"], "--license my own: expected an SPDX name"),
        (["publish", ".", "--out", "x.zip", "--date", "today"], "--date today: expected YYYY-MM-DD"),
    ],
)
def test_mistakes_are_one_line(mrpbench, words, what):
    code, _, errors = mrpbench(*words)
    assert code == 2
    assert errors.startswith(what)
    assert errors.count("\n") == 1


REFUSING = """\
import attrs
from mrpbench_core.api.dispatcher import Dispatcher, DispatchError

@attrs.frozen
class Refuse(Dispatcher):
    def start(self, problem, plan):
        raise DispatchError("no")
"""


def test_reports_and_sites_say_nothing_of_recordings_of_runs_that_did_not_move(mrpbench, caplog):
    Path("refuse.py").write_text(REFUSING)
    settings = ["simulator=kinematic", "dispatcher=./refuse.py:Refuse", "recording.keep=all", "seed=0"]
    mrpbench("run", "tiny.yaml", *settings)
    assert mrpbench("report", "results/tiny")[0] == 0
    assert "execution aborted: no</figcaption>" in Path("results/tiny/report.html").read_text()
    assert mrpbench("publish", "results/tiny", "--out", "tiny.zip")[0] == 0
    assert mrpbench("verify", "tiny.zip", "--trust-sources", "--out", "tiny.zip.verdict.json")[0] == 0
    code, output, _ = mrpbench("site", "tiny.zip", "--out", "public")
    assert code == 0
    assert output.endswith(".zip: verified, no run repeated\n")
    assert not caplog.text
    assert not list(Path("public/replays").glob("*.html"))
