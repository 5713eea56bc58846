"""`mrpbench world … --write FILE`: suffixes, and the robots of a run."""

import pytest
import yaml
from mrpbench_world.write import write_run

from mrpbench_core.files.errors import InputError


def test_a_map_has_the_robots_beside_it(recording, tmp_path):
    write_run(recording, tmp_path / "case.yaml")
    assert yaml.safe_load((tmp_path / "case.yaml").read_text())["image"] == "case.pgm"
    robots = yaml.safe_load((tmp_path / "case.robots.yaml").read_text())["robots"]
    assert [robot["name"] for robot in robots] == list(recording.context().fleet.names)
    assert robots[1]["start"] == [2.2, 1.5, 0.0]
    assert len(robots[0]["goal"]) == 3


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["office", "--write", "x.foo"], "no format has the suffix '.foo'"),
        (["office", "--write", "nowhere/x.sdf"], "x.sdf: cannot be written: No such file or directory"),
        ([], "no world is named"),
        (["office", "--run", "results"], "--run names a world and needs --write FILE"),
        (["--run", "results"], "--run names a world and needs --write FILE"),
    ],
)
def test_mistakes_are_one_line(words, line, mrpbench):
    code, _, err = mrpbench("world", *words)
    assert code == 2
    assert line in err
    assert len(err.splitlines()) == 1


def test_a_movingai_map_has_no_robots(recording, tmp_path):
    with pytest.raises(InputError, match="has no robots"):
        write_run(recording, tmp_path / "case.map")
