"""`mrpbench check`."""

import json

import pytest

GOOD = """\
import attrs
from mrpbench_core.api import Assigner
from mrpbench_core.builtin.assigners.identity import Identity


@attrs.frozen(kw_only=True)
class Mine(Identity):
    \"\"\"Like identity.\"\"\"

    def assign(self, problem):
        print("noise")
        return Identity.assign(self, problem)


@attrs.frozen(kw_only=True)
class Bad(Identity):
    \"\"\"Gives every robot the first task.\"\"\"

    def assign(self, problem):
        import attrs, numpy
        return attrs.evolve(super(Bad, self).assign(problem), task=numpy.zeros(len(problem.costs)))


class Other:
    pass
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / "mine.py").write_text(GOOD)


def test_one_line_for_each_check(mrpbench):
    code, out, err = mrpbench("check", "identity")
    lines = out.splitlines()
    assert code == 0
    assert not err
    assert "ok       gives each task to one robot" in lines
    assert "skipped  is optimal: it does not read costs" in lines
    assert lines[-1] == f"assigner identity: {len(lines) - 4} ok, 0 failed, 3 skipped"


def test_a_local_class(mrpbench, file):
    code, out, err = mrpbench("check", "./mine.py:Mine")
    assert code == 0
    assert "noise" not in out
    assert "noise" in err
    assert "assigner ./mine.py:Mine: " in out


def test_a_failure_is_said_and_is_exit_code_1(mrpbench, file):
    code, out, _ = mrpbench("check", "./mine.py:Bad")
    assert code == 1
    assert "failed   gives each task to one robot: 2 robots, 2 tasks: gives task 0 to 2 robots" in out


def test_json(mrpbench, file):
    code, out, _ = mrpbench("check", "--json", "assigner:./mine.py:Bad")
    facts = json.loads(out)
    assert code == 1
    assert facts["kind"] == "assigner"
    assert facts["failed"] == sum(check["outcome"] == "failed" for check in facts["checks"]) > 0
    assert facts["component"] == "Bad(cost='euclidean')"


def test_options(mrpbench):
    code, out, _ = mrpbench("check", "scenario:random", "robots=2")
    assert code == 0
    assert "skipped  works with its defaults: it has no defaults for: robots" in out


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["random"], "random.robots: is missing (number of robots)"),
        (["random", "robots=many"], "robots"),
        (["identiti"], "no plugin is called 'identiti' (did you mean 'identity'?)"),
        (["movingai"], "several kinds have a plugin 'movingai' (write scenario:movingai or world:movingai)"),
        (["planner:identity"], "no planner is called 'identity'"),
        (["./mine.py:Other"], "is not a component"),
        (["./mine.py:Missing"], "mine.py has no 'Missing'"),
        (["./none.py:Mine"], "none.py"),
        (["identity", "robots"], "expected KEY=VALUE"),
        ([], "NAME"),
    ],
)
def test_mistakes_are_one_line(mrpbench, file, words, line):
    code, out, err = mrpbench("check", *words)
    assert code == 2
    assert not out
    assert line in err
    assert err.count("\n") == 1


def test_an_installed_plugin_that_breaks_its_contract(mrpbench, install):
    code = """
        from mrpbench_core.builtin.assigners.identity import Identity
        class Thawed(Identity):
            pass
    """
    install("acme-thawed", {"mrpbench.assigners": {"thawed": "{module}:Thawed"}}, code)
    code, _, err = mrpbench("check", "thawed")
    assert code == 2
    assert "is not decorated @attrs.frozen(kw_only=True)" in err


def test_a_kind_that_a_plugin_defines(mrpbench, install):
    code = """
        from typing import ClassVar
        import attrs
        from mrpbench_core.api.component import Component, option

        class Critic(Component):
            group: ClassVar[str] = "mrpbench.critics"

        @attrs.frozen(kw_only=True)
        class Mild(Critic):
            '''Likes most things.'''

            scale: float = option(1.0, help="weight")
    """
    install("acme-critics", {"mrpbench.critics": {"mild": "{module}:Mild"}}, code)
    for name in ("mild", "critic:mild"):
        code, out, _ = mrpbench("check", name, "scale=2.0")
        assert code == 0
        assert out.splitlines()[-1] == f"critic {name}: 8 ok, 0 failed, 0 skipped"
